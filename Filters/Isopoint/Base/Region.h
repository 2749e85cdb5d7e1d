// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Region_h
#define isopoint_Region_h

#include <cmath>

namespace isopoint
{

/// A closed axis-parallel box, the region of a node. Its bounds are the input's coordinates and
/// splitting planes, both in double: comparing them is exact.
struct Region
{
  double lower[3];
  double upper[3];

  /// The axis of the longest side, the lowest one among equals.
  int longestSide() const
  {
    const double side[3] = { this->upper[0] - this->lower[0], this->upper[1] - this->lower[1],
      this->upper[2] - this->lower[2] };
    int longest = side[1] > side[0] ? 1 : 0;
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
