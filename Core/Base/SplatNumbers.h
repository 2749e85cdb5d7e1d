// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// A corner of a splat: its offset from the point, in units of the splat's radius, and the surface
/// normal there, along normal + slopeAlong * t1 + slopeAcross * t2.
struct SplatCorner
{
  float along;  // t1
  float across; // t2
  float height; // along the normal
  float slopeAlong;
  float slopeAcross;
};

/// Splats with more corners lose their shortest sides.
constexpr std::size_t maxCorners = 8;

using SplatCorners = std::array<SplatCorner, maxCorners>;

/// Output layout: the members of each corner in order, corner after corner.
constexpr std::size_t numbersOfCorner = 5;
constexpr std::size_t numbersOfSplat = numbersOfCorner * maxCorners;
using SplatNumbers = std::array<double, numbersOfSplat>;

inline SplatNumbers numbersOf(const SplatCorners& corners)
{
  SplatNumbers numbers;
  auto next = numbers.begin();
  for (const SplatCorner& corner : corners)
  {
    for (const float number :
      { corner.along, corner.across, corner.height, corner.slopeAlong, corner.slopeAcross })
    {
      *next++ = number;
    }
  }
  return numbers;
}

/// Output form of a radius: a float; positive radii are clamped to the positive range of float.
inline float radiusNumber(double radius)
{
  using Limits = std::numeric_limits<float>;
  return radius > 0.0 ? static_cast<float>(std::clamp<double>(
                          radius, Limits::denorm_min(), static_cast<double>(Limits::max())))
                      : 0.0f;
}

} // namespace isopoint
