// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Interpolation_h
#define isopoint_Interpolation_h

#include <cmath>

namespace isopoint
{

/// Where a value stands between those of an edge's ends: 0 at `first`, 1 at `second`, which differ
/// and have `value` between them.
inline double edgeParameter(double first, double second, double value)
{
  const double difference = second - first;
  return std::isfinite(difference) ? (value - first) / difference
                                   : (0.5 * value - 0.5 * first) / (0.5 * second - 0.5 * first);
}

/// Linear interpolation along an edge. The second form is for differences beyond double's range.
inline double interpolate(double first, double second, double parameter)
{
  const double difference = second - first;
  return std::isfinite(difference) ? first + parameter * difference
                                   : (1.0 - parameter) * first + parameter * second;
}

} // namespace isopoint

#endif
