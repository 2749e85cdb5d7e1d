// SPDX-License-Identifier: GPL-3.0-or-later
// The predicates of CGAL's tetrahedrization; see BandInsertion.h.
#ifndef isopoint_BandKernel_h
#define isopoint_BandKernel_h

#include "Isopoint/Tetrahedra/CoordinateUnit.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_structural_filtering_traits.h>
#include <CGAL/determinant.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint::band
{

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// Up to this many units, the determinants of points' differences are exact in double: integers
/// below 2^53.
constexpr double mostUnitsForOrientation = 0x1p16; // 6 (2^16)^3
constexpr double mostUnitsForSphere = 0x1p9;       // 72 (2^9)^5

/// The differences of points from the last of them, in which predicates are polynomials.
template <std::size_t Count>
class Differences
{
public:
  template <class... Points>
  explicit Differences(const Point& origin, const Points&... points)
    : X{ points.x() - origin.x()... }
    , Y{ points.y() - origin.y()... }
    , Z{ points.z() - origin.z()... }
  {
  }

  /// Whether none exceeds a length.
  bool areWithin(double length) const
  {
    double largest = 0.0;
    for (std::size_t i = 0; i < Count; ++i)
    {
      largest =
        std::max({ largest, std::abs(this->X[i]), std::abs(this->Y[i]), std::abs(this->Z[i]) });
    }
    return largest <= length;
  }

  double squaredLength(std::size_t i) const
  {
    return this->X[i] * this->X[i] + this->Y[i] * this->Y[i] + this->Z[i] * this->Z[i];
  }

  std::array<double, Count> X;
  std::array<double, Count> Y;
  std::array<double, Count> Z;
};

/// CGAL's kernel of exact predicates, quicker where the coordinates of all points have a common
/// unit and points lie so close together that doubles are exact. CGAL would have to find out by
/// other arithmetic, since many of the determinants are 0.
class Kernel : public CGAL::Exact_predicates_inexact_constructions_kernel
{
public:
  /// @param unit of all points that predicates see; must outlive this and all copies of it. Null:
  /// none
  explicit Kernel(const CoordinateUnit* unit = nullptr)
    : Unit(unit)
  {
  }

  class Orientation_3
  {
  public:
    using result_type = CGAL::Orientation;

    explicit Orientation_3(double unit)
      : Most(mostUnitsForOrientation * unit)
    {
    }

    CGAL::Orientation operator()(
      const Point& p, const Point& q, const Point& r, const Point& s) const
    {
      if (this->Most > 0.0)
      {
        const Differences<3> d(p, q, r, s);
        if (d.areWithin(this->Most))
        {
          return CGAL::sign(CGAL::determinant(
            d.X[0], d.Y[0], d.Z[0], d.X[1], d.Y[1], d.Z[1], d.X[2], d.Y[2], d.Z[2]));
        }
      }
      return CGAL::Exact_predicates_inexact_constructions_kernel::Orientation_3()(p, q, r, s);
    }

  private:
    double Most;
  };

  class Side_of_oriented_sphere_3
  {
  public:
    using result_type = CGAL::Oriented_side;

    explicit Side_of_oriented_sphere_3(double unit)
      : Most(mostUnitsForSphere * unit)
    {
    }

    CGAL::Oriented_side operator()(
      const Point& p, const Point& q, const Point& r, const Point& s, const Point& t) const
    {
      if (this->Most > 0.0)
      {
        const Differences<4> d(t, p, r, q, s);
        if (d.areWithin(this->Most))
        {
          return CGAL::sign(CGAL::determinant(d.X[0], d.Y[0], d.Z[0], d.squaredLength(0), d.X[1],
            d.Y[1], d.Z[1], d.squaredLength(1), d.X[2], d.Y[2], d.Z[2], d.squaredLength(2), d.X[3],
            d.Y[3], d.Z[3], d.squaredLength(3)));
        }
      }
      return CGAL::Exact_predicates_inexact_constructions_kernel::Side_of_oriented_sphere_3()(
        p, q, r, s, t);
    }

  private:
    double Most;
  };

  Orientation_3 orientation_3_object() const { return Orientation_3(this->unit()); }
  Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() const
  {
    return Side_of_oriented_sphere_3(this->unit());
  }

private:
  double unit() const { return this->Unit ? this->Unit->value() : 0.0; }

  const CoordinateUnit* Unit;
};

} // namespace isopoint::band

namespace CGAL
{

/// Points are located as with the kernel that this one derives from.
template <>
struct Triangulation_structural_filtering_traits<isopoint::band::Kernel>
  : Triangulation_structural_filtering_traits<Exact_predicates_inexact_constructions_kernel>
{
};

} // namespace CGAL

#endif
