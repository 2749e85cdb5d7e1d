// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Interpolation_h
#define isopoint_Interpolation_h

#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

/// The parameter at which linear interpolation between two different values has a third one between
/// them: 0 at `first`, 1 at `second`. The second form is for differences beyond double's range.
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

inline Vector interpolate(const Vector& first, const Vector& second, double parameter)
{
  return { interpolate(first[0], second[0], parameter), interpolate(first[1], second[1], parameter),
    interpolate(first[2], second[2], parameter) };
}

/// The parameter, within 0 and 1, of the place on an edge that is nearest to a position.
inline double nearestParameter(const Vector& first, const Vector& second, const Vector& position)
{
  const Vector along = difference(second, first);
  const double parameter = dot(difference(position, first), directionOf(along)) / lengthOf(along);
  return std::min(std::max(parameter, 0.0), 1.0);
}

} // namespace isopoint

#endif
