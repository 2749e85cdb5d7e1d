// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// A position, direction or offset in space.
using Vector = std::array<double, 3>;

/// Second derivatives xx, yy, zz, xy, xz, yz.
using Hessian = std::array<double, 6>;

inline bool isFinite(const Vector& vector)
{
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

inline double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline Vector operator+(const Vector& a, const Vector& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline Vector& operator+=(Vector& a, const Vector& b)
{
  return a = a + b;
}

inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline Vector operator-(const Vector& a)
{
  return { -a[0], -a[1], -a[2] };
}

inline Vector operator*(double factor, const Vector& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

/// Does not overflow or underflow where squares do. NaN if a component is infinite, or if one is
/// NaN and another is not 0. std::hypot is avoided: its last bits differ among libraries.
inline double lengthOf(const Vector& a)
{
  const double x = std::abs(a[0]);
  const double y = std::abs(a[1]);
  const double z = std::abs(a[2]);
  const double largest = x < y ? (y < z ? z : y) : (x < z ? z : x);
  return largest != 0.0
           ? largest * std::sqrt((x / largest) * (x / largest) + (y / largest) * (y / largest) +
                                 (z / largest) * (z / largest))
           : 0.0;
}

/// @returns the vector at length 1, or the x axis for the zero vector
inline Vector directionOf(const Vector& a)
{
  const double length = lengthOf(a);
  return length > 0.0 ? Vector{ a[0] / length, a[1] / length, a[2] / length }
                      : Vector{ 1.0, 0.0, 0.0 };
}

/// Two unit vectors orthogonal to a normal, with first x second = normal. They depend only on it.
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

/// Number of directions in which the extent of the samples is measured.
constexpr std::size_t extentCount = 8;

/// Unit vectors orthogonal to a normal, at equal angles.
inline std::array<Vector, extentCount> extentDirections(const Vector& normal)
{
  constexpr double diagonal = 0.70710678118654752; // 1 / sqrt 2
  const TangentFrame frame(normal);
  const Vector upwards = diagonal * frame.second;
  const Vector downwards = -upwards;
  return { frame.first, upwards + diagonal * frame.first, frame.second,
    upwards - diagonal * frame.first, -frame.first, downwards - diagonal * frame.first,
    -frame.second, downwards + diagonal * frame.first };
}

/// The parameter at which linear interpolation yields `value`: 0 at `first`, 1 at `second`, which
/// differ. The second form is for differences that overflow.
inline double edgeParameter(double first, double second, double value)
{
  const double difference = second - first;
  return std::isfinite(difference) ? (value - first) / difference
                                   : (0.5 * value - 0.5 * first) / (0.5 * second - 0.5 * first);
}

/// Linear interpolation. The second form is for differences that overflow.
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

/// The parameter, in [0, 1], of the point on an edge that is nearest to a position.
inline double nearestParameter(const Vector& first, const Vector& second, const Vector& position)
{
  const Vector along = second - first;
  const double parameter = dot(position - first, directionOf(along)) / lengthOf(along);
  return std::min(std::max(parameter, 0.0), 1.0);
}

} // namespace isopoint
