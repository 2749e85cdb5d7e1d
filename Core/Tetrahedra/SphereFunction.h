// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SphereFunction_h
#define isopoint_SphereFunction_h

#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint
{

/// Where a position stands, as far as double precision shows.
enum class Side
{
  Inside,
  Unknown,
  Outside
};

/// A ball or half-space as the places x with F(x) < 0, where
///
///     F(x) = d |y|^2 - 2 n . y,    y = scale * (x - origin),    d >= 0,
///
/// and the origin lies on its boundary. (A ball has the center y = n / d; a half-space has d = 0.)
/// This form loses nothing as balls become huge, and it is a sum over the axes: its least value
/// over a box is the sum of three. Bounds on the errors of d and n are known, so that all answers
/// are certain.
class SphereFunction
{
public:
  /// @param scale a power of two that brings differences of coordinates near 1
  /// @param dError, nError bounds on the errors of d and n. They also have to cover the rounding in
  /// the evaluation of F, 16 units in the last place of d and of each n
  SphereFunction(const Vector& origin, double scale, double d, double dError, const Vector& n,
    const Vector& nError)
    : Scale(scale)
    , ScaledOrigin{ scale * origin[0], scale * origin[1], scale * origin[2] }
    , LowD(std::max(0.0, d - dError))
    , HighD(d + dError)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      this->Ahead[a] = 2.0 * (n[a] + nError[a]);
      this->Behind[a] = 2.0 * (n[a] - nError[a]);
      this->LowestAhead[a] = placeOfLeast(this->Ahead[a], this->LowD);
      this->LowestBehind[a] = placeOfLeast(this->Behind[a], this->LowD);
      this->Center[a] = placeOfLeast(2.0 * n[a], this->LowD);
    }
  }

  /// A lower bound on an axis' share of F between two coordinates.
  double least(int axis, double lower, double upper) const
  {
    const auto a = static_cast<std::size_t>(axis);
    const double low = this->Scale * lower - this->ScaledOrigin[a];
    const double high = this->Scale * upper - this->ScaledOrigin[a];
    double result = HUGE_VAL;
    if (high >= 0.0)
    {
      const double y = std::min(std::max(this->LowestAhead[a], std::max(low, 0.0)), high);
      result = y * (this->LowD * y - this->Ahead[a]);
    }
    if (low <= 0.0)
    {
      const double y = std::max(std::min(this->LowestBehind[a], std::min(high, 0.0)), low);
      result = std::min(result, y * (this->LowD * y - this->Behind[a]));
    }
    return result;
  }

  /// Whether the part of a box above a coordinate is nearer to the center than that below.
  bool isAbove(int axis, double coordinate) const
  {
    const auto a = static_cast<std::size_t>(axis);
    return this->Center[a] > this->Scale * coordinate - this->ScaledOrigin[a];
  }

  /// Whether shares of the axes, computed by least(), add up to a value that is certainly positive.
  static bool isPositive(const Vector& shares) { return shares[0] + shares[1] + shares[2] > tiny; }
  static bool isNotNegative(const Vector& shares)
  {
    return shares[0] + shares[1] + shares[2] >= -tiny;
  }

  Side sideOf(const Vector& position) const
  {
    Vector low;
    Vector high;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double y = this->Scale * position[a] - this->ScaledOrigin[a];
      low[a] = y * (this->LowD * y - (y >= 0.0 ? this->Ahead[a] : this->Behind[a]));
      high[a] = y * (this->HighD * y - (y >= 0.0 ? this->Behind[a] : this->Ahead[a]));
    }
    if (isPositive(low))
    {
      return Side::Outside;
    }
    return high[0] + high[1] + high[2] < -tiny ? Side::Inside : Side::Unknown;
  }

private:
  /// More than all that is lost where products underflow: values of F are near 1 or 0.
  static constexpr double tiny = 1e-290;

  /// Where d y^2 - b y is least.
  static double placeOfLeast(double b, double d)
  {
    return b == 0.0 ? 0.0 : b / (2.0 * d); // infinite for half-spaces
  }

  double Scale;
  Vector ScaledOrigin;
  double LowD;
  double HighD;
  Vector Ahead;       // 2 n and its error, for y >= 0
  Vector Behind;      // for y <= 0
  Vector LowestAhead; // where the bound is least
  Vector LowestBehind;
  Vector Center;
};

/// The corners of a cell of a Delaunay triangulation of a set of positions, in the order that makes
/// the orientation positive: det(p1 - p0, p2 - p0, p3 - p0) > 0.
using TetrahedronCorners = std::array<Vector, 4>;

/// The corners of a facet of the convex hull, such that det(p1 - p0, p2 - p0, x - p0) > 0 for x
/// beyond it.
using HullFacetCorners = std::array<Vector, 3>;

/// The ball around a tetrahedron that is not flat.
SphereFunction ballAround(const TetrahedronCorners& corners);

/// The half-space beyond a facet of the hull that is not degenerate.
SphereFunction halfSpaceBeyond(const HullFacetCorners& corners);

/// The smallest ball whose boundary passes through the corners of a facet.
SphereFunction ballThrough(const HullFacetCorners& corners);

} // namespace isopoint

#endif
