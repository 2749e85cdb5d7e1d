// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TangentFrame_h
#define isopoint_TangentFrame_h

#include "Isopoint/Base/Vector.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// Two unit vectors orthogonal to a normal, first x second along it. They depend on nothing but the
/// normal.
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

/// The number of directions in which the extent of the samples around a place is measured.
constexpr std::size_t extentCount = 8;

/// Unit vectors orthogonal to a normal, at equal angles around it.
inline std::array<Vector, extentCount> extentDirections(const Vector& normal)
{
  constexpr double diagonal = 0.70710678118654752; // 1 / sqrt 2
  const TangentFrame frame(normal);
  const Vector upwards = scaled(diagonal, frame.second);
  const Vector downwards = scaled(-1.0, upwards);
  return { frame.first, sum(upwards, diagonal, frame.first), frame.second,
    sum(upwards, -diagonal, frame.first), scaled(-1.0, frame.first),
    sum(downwards, -diagonal, frame.first), scaled(-1.0, frame.second),
    sum(downwards, diagonal, frame.first) };
}

} // namespace isopoint

#endif
