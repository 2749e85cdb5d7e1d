// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialZero_h
#define isopoint_PolynomialZero_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/Polynomial.h"

#include <optional>

namespace isopoint
{

/// In units near the edge's length: where steps converge, the next one is of about the square.
constexpr double zeroAccuracy = 1e-6;

/// Follows Newton's method until its steps vanish.
/// @param stepAt(place) the next step from a place in the frame of a fit
/// @returns where, unless that is farther from the start than a distance or takes too many steps
template <class Step>
std::optional<Vector> followToZero(const Vector& start, double farthest, const Step& stepAt)
{
  constexpr int mostSteps = 8;
  Vector place = start;
  for (int i = 0; i < mostSteps; ++i)
  {
    const Vector step = stepAt(place);
    place = sum(place, 1.0, step);
    const Vector offset = difference(place, start);
    if (!(dot(offset, offset) <= farthest * farthest)) // nor is it a number, where the slope is 0
    {
      return std::nullopt;
    }
    if (dot(step, step) <= zeroAccuracy * zeroAccuracy)
    {
      return place;
    }
  }
  return std::nullopt;
}

/// The zero of a polynomial that is reached along gradients.
inline std::optional<Vector> zeroNear(
  const Polynomial& polynomial, double farthest, const Vector& start = {})
{
  return followToZero(start, farthest,
    [&polynomial](const Vector& place)
    {
      const Vector gradient = polynomial.gradientAt(place);
      return scaled(-polynomial.valueAt(place) / dot(gradient, gradient), gradient);
    });
}

} // namespace isopoint

#endif
