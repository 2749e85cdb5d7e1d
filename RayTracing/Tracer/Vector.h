// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace raytracing
{

/// A position, direction or color in single precision, as Embree uses.
struct Vector
{
  float x = 0.0f;
  float y = 0.0f;
  float z = 0.0f;
};

/// Red, green and blue as displayed; 1 is white.
using Color = Vector;

inline Vector operator+(const Vector& a, const Vector& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}

inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

inline Vector operator-(const Vector& a)
{
  return { -a.x, -a.y, -a.z };
}

inline Vector operator*(float factor, const Vector& a)
{
  return { factor * a.x, factor * a.y, factor * a.z };
}

/// The componentwise product, as of a light's and a surface's color.
inline Vector operator*(const Vector& a, const Vector& b)
{
  return { a.x * b.x, a.y * b.y, a.z * b.z };
}

inline Vector& operator+=(Vector& a, const Vector& b)
{
  return a = a + b;
}

inline float dot(const Vector& a, const Vector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vector cross(const Vector& a, const Vector& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

inline float lengthOf(const Vector& a)
{
  return std::sqrt(dot(a, a));
}

/// @returns the vector scaled to length 1, or a substitute if it has no direction
inline Vector directionOf(const Vector& a, const Vector& substitute = { 0.0f, 0.0f, 1.0f })
{
  const float length = lengthOf(a);
  return length > 0.0f ? (1.0f / length) * a : substitute;
}

inline Vector mixed(const Vector& a, const Vector& b, float share)
{
  return (1.0f - share) * a + share * b;
}

inline float largestOf(const Vector& a)
{
  return std::max({ a.x, a.y, a.z });
}

/// A unit vector with two unit vectors orthogonal to it and to each other.
struct Frame
{
  Vector first;
  Vector second;
  Vector normal;

  /// [DBC+17]
  explicit Frame(const Vector& n)
    : normal(n)
  {
    const float sign = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    first = { 1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x };
    second = { b, sign + n.y * n.y * a, -n.y };
  }

  Vector toWorld(const Vector& v) const { return v.x * first + v.y * second + v.z * normal; }
  Vector toLocal(const Vector& v) const
  {
    return { dot(v, first), dot(v, second), dot(v, normal) };
  }
};

} // namespace raytracing
