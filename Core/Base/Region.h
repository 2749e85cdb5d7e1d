// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// A closed axis-parallel box, the region of a node. Its bounds are coordinates of the input and
/// splitting planes as doubles, so comparisons are exact.
struct Region
{
  Vector lower;
  Vector upper;

  /// The longest axis; the lowest one among equals.
  int longestSide() const
  {
    const Vector side = this->upper - this->lower;
    const int longest = side[1] > side[0] ? 1 : 0;
    return side[2] > side[longest] ? 2 : longest;
  }
};

constexpr double unbounded = std::numeric_limits<double>::infinity();

constexpr Region everywhere{ { -unbounded, -unbounded, -unbounded },
  { unbounded, unbounded, unbounded } };
constexpr Region emptyRegion{ everywhere.upper, everywhere.lower };

/// The smallest box around two boxes.
inline Region united(const Region& a, const Region& b)
{
  Region box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    box.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
  }
  return box;
}

/// How far a position is outside a box, along each axis.
inline Vector gapTo(const Region& box, const Vector& position)
{
  Vector gap{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    gap[axis] =
      std::max({ box.lower[axis] - position[axis], position[axis] - box.upper[axis], 0.0 });
  }
  return gap;
}

/// The part of a box within a radius of a position, along each axis, with a margin for rounding.
inline Region partWithin(Region box, const Vector& position, double radius)
{
  const double reach = 1.001 * radius;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::max(box.lower[axis], position[axis] - reach);
    box.upper[axis] = std::min(box.upper[axis], position[axis] + reach);
  }
  return box;
}

/// The splitting plane halfway between the last coordinate of the lower half and the first of the
/// upper half: last <= result <= first.
inline double splittingPlaneBetween(double last, double first)
{
  const double halfway = 0.5 * (last + first);
  return std::isfinite(halfway) ? halfway : 0.5 * last + 0.5 * first;
}

} // namespace isopoint
