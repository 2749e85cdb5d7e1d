// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TangentFrame_h
#define isopoint_TangentFrame_h

#include "Isopoint/Base/Vector.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// Two axes of length 1 across a normal, first x second along it. Any would do; these depend on
/// nothing but the normal.
struct TangentFrame
{
  Vector first;
  Vector second;

  /// @param normal of length 1
  explicit TangentFrame(const Vector& normal)
  {
    std::size_t flattest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      flattest = std::abs(normal[axis]) < std::abs(normal[flattest]) ? axis : flattest;
    }
    Vector unit{ 0.0, 0.0, 0.0 };
    unit[flattest] = 1.0;
    this->first = directionOf(cross(normal, unit));
    this->second = cross(normal, this->first);
  }
};

/// In how many directions it is told how far samples stand from a place.
constexpr std::size_t extentCount = 8;

/// Directions of length 1, evenly around a normal.
inline std::array<Vector, extentCount> extentDirections(const Vector& normal)
{
  constexpr double diagonal = 0.70710678118654752; // 1 / sqrt 2
  const TangentFrame frame(normal);
  const Vector rising = scaled(diagonal, frame.second);
  const Vector falling = scaled(-1.0, rising);
  return { frame.first, sum(rising, diagonal, frame.first), frame.second,
    sum(rising, -diagonal, frame.first), scaled(-1.0, frame.first),
    sum(falling, -diagonal, frame.first), scaled(-1.0, frame.second),
    sum(falling, diagonal, frame.first) };
}

} // namespace isopoint

#endif
