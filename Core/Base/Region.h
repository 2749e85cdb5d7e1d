// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Region_h
#define isopoint_Region_h

#include "Core/Base/Vector.h"

#include <cmath>

namespace isopoint
{

/// A closed axis-parallel box, the region of a node. Its bounds are coordinates of the input and
/// splitting planes, both in double: comparing them is exact.
struct Region
{
  Vector lower;
  Vector upper;

  /// The axis of the longest side, the lowest one among equals.
  int longestSide() const
  {
    const Vector side = difference(this->upper, this->lower);
    const int longest = side[1] > side[0] ? 1 : 0;
    return side[2] > side[longest] ? 2 : longest;
  }
};

/// Where the region of two halves is cut: halfway between the last coordinate of the lower half
/// and the first one of the upper half, `last` <= result <= `first`.
inline double splittingPlaneBetween(double last, double first)
{
  const double halfway = 0.5 * (last + first);
  return std::isfinite(halfway) ? halfway : 0.5 * last + 0.5 * first;
}

} // namespace isopoint

#endif
