// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint
{

/// The side of a sphere that a position is on, as far as double precision can tell.
enum class Side
{
  Inside,
  Unknown,
  Outside
};

/// A ball or half-space: the points x with F(x) < 0, where
///
///     F(x) = d |y|^2 - 2 n . y,    y = scale * (x - origin),    d >= 0,
///
/// with the origin on its boundary. A ball has its center at y = n / d; a half-space has d = 0.
/// This form stays accurate for huge balls. It is a sum over the axes, so the minimum over a box is
/// the sum of three minima. Error bounds on d and n make all answers certain.
class SphereFunction
{
public:
  /// @param scale a power of two that brings differences of coordinates near 1
  /// @param dError, nError bounds on the errors of d and n. They must also cover the rounding in
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
      this->LowestAhead[a] = minimizer(this->Ahead[a], this->LowD);
      this->LowestBehind[a] = minimizer(this->Behind[a], this->LowD);
      this->Center[a] = minimizer(2.0 * n[a], this->LowD);
    }
  }

  /// A lower bound of an axis' term of F between two coordinates.
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

  /// least() by axis for a box.
  Vector leastIn(const Region& box) const
  {
    return { this->least(0, box.lower[0], box.upper[0]), this->least(1, box.lower[1], box.upper[1]),
      this->least(2, box.lower[2], box.upper[2]) };
  }

  /// Whether the upper part of a box, split at a coordinate, is nearer to the center.
  bool isAbove(int axis, double coordinate) const
  {
    const auto a = static_cast<std::size_t>(axis);
    return this->Center[a] > this->Scale * coordinate - this->ScaledOrigin[a];
  }

  /// A lower bound of F, of terms from least().
  static double sum(const Vector& shares) { return shares[0] + shares[1] + shares[2]; }

  /// Whether a sum of terms from least() is certainly positive.
  static bool isPositive(const Vector& shares) { return sum(shares) > tiny; }
  static bool isNotNegative(const Vector& shares) { return sum(shares) >= -tiny; }

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
    return sum(high) < -tiny ? Side::Inside : Side::Unknown;
  }

private:
  /// Exceeds all underflow in products: values of F are near 1 or 0.
  static constexpr double tiny = 1e-290;

  /// The y of the minimum of d y^2 - b y.
  static double minimizer(double b, double d)
  {
    return b == 0.0 ? 0.0 : b / (2.0 * d); // infinite for half-spaces
  }

  double Scale;
  Vector ScaledOrigin;
  double LowD;
  double HighD;
  Vector Ahead;       // 2 n and its error, for y >= 0
  Vector Behind;      // for y <= 0
  Vector LowestAhead; // minimizer of the bound
  Vector LowestBehind;
  Vector Center;
};

/// The corners of a Delaunay tetrahedron, with det(p1 - p0, p2 - p0, p3 - p0) > 0.
using TetrahedronCorners = std::array<Vector, 4>;

/// The corners of a facet of the convex hull: det(p1 - p0, p2 - p0, x - p0) > 0 for x beyond it.
using HullFacetCorners = std::array<Vector, 3>;

/// The circumscribed ball of a tetrahedron that is not flat.
SphereFunction ballAround(const TetrahedronCorners& corners);

/// The half-space beyond a nondegenerate facet of the hull.
SphereFunction halfSpaceBeyond(const HullFacetCorners& corners);

/// The smallest ball with the corners of a facet on its boundary.
SphereFunction ballThrough(const HullFacetCorners& corners);

} // namespace isopoint
