// SPDX-License-Identifier: GPL-3.0-or-later
// The predicates of CGAL's tetrahedralization; see ParallelInsertion.h.
#pragma once

#include "Core/Tetrahedra/CoordinateUnit.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_structural_filtering_traits.h>
#include <CGAL/determinant.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint::cgal
{

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// The differences of points from the last one; predicates are polynomials in them.
template <std::size_t Count>
class Differences
{
public:
  explicit Differences(const std::array<const Point*, Count + 1>& points)
  {
    const Point& origin = *points[Count];
    for (std::size_t i = 0; i < Count; ++i)
    {
      this->X[i] = points[i]->x() - origin.x();
      this->Y[i] = points[i]->y() - origin.y();
      this->Z[i] = points[i]->z() - origin.z();
    }
  }

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

/// The orientation of four points. Doubles are exact up to `maxUnits`: integers up to 6 (2^16)^3.
struct OrientationDeterminant
{
  static constexpr double maxUnits = 0x1p16;

  double operator()(const Differences<3>& d) const
  {
    return CGAL::determinant(
      d.X[0], d.Y[0], d.Z[0], d.X[1], d.Y[1], d.Z[1], d.X[2], d.Y[2], d.Z[2]);
  }
};

/// On which side of a sphere through four points a fifth lies: integers up to 72 (2^9)^5.
struct SphereDeterminant
{
  static constexpr double maxUnits = 0x1p9;

  double operator()(const Differences<4>& d) const
  {
    return CGAL::determinant(d.X[0], d.Y[0], d.Z[0], d.squaredLength(0), d.X[1], d.Y[1], d.Z[1],
      d.squaredLength(1), d.X[2], d.Y[2], d.Z[2], d.squaredLength(2), d.X[3], d.Y[3], d.Z[3],
      d.squaredLength(3));
  }
};

/// A CGAL predicate with the sign opposite to a determinant's: uses doubles where they are exact.
template <class CgalPredicate, class Determinant>
class UnitPredicate
{
public:
  using result_type = CGAL::Sign; // not all versions of CGAL name it

  /// @param unit of the points' coordinates, or 0
  explicit UnitPredicate(double unit)
    : Most(Determinant::maxUnits * unit)
  {
  }

  template <class... Points>
  result_type operator()(const Points&... points) const
  {
    if (this->Most > 0.0)
    {
      const Differences<sizeof...(Points) - 1> differences({ &points... });
      if (differences.areWithin(this->Most))
      {
        return -CGAL::sign(Determinant()(differences));
      }
    }
    return CgalPredicate()(points...);
  }

private:
  double Most;
};

/// CGAL's kernel with exact predicates. It is faster if coordinates have a common unit and points
/// are so close that doubles are exact. CGAL's filters fail there, because many determinants are 0.
class Kernel : public CGAL::Exact_predicates_inexact_constructions_kernel
{
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

public:
  using Orientation_3 = UnitPredicate<Exact::Orientation_3, OrientationDeterminant>;
  using Side_of_oriented_sphere_3 =
    UnitPredicate<Exact::Side_of_oriented_sphere_3, SphereDeterminant>;

  /// @param unit of all points that predicates see; must outlive this and all copies; null for none
  explicit Kernel(const CoordinateUnit* unit = nullptr)
    : Unit(unit)
  {
  }

  Orientation_3 orientation_3_object() const { return Orientation_3(this->unit()); }
  Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() const
  {
    return Side_of_oriented_sphere_3(this->unit());
  }

private:
  double unit() const { return this->Unit ? this->Unit->value() : 0.0; }

  const CoordinateUnit* Unit;
};

} // namespace isopoint::cgal

namespace CGAL
{

/// Locates points in the same way as the base kernel.
template <>
struct Triangulation_structural_filtering_traits<isopoint::cgal::Kernel>
  : Triangulation_structural_filtering_traits<Exact_predicates_inexact_constructions_kernel>
{
};

} // namespace CGAL
