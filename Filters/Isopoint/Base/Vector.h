// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Vector_h
#define isopoint_Vector_h

#include <array>
#include <cmath>

namespace isopoint
{

/// A position, direction or offset in space; the core's one vector type.
using Vector = std::array<double, 3>;

/// The second derivatives xx, yy, zz, xy, xz, yz of a function of the position.
using Hessian = std::array<double, 6>;

inline double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline Vector difference(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// a + factor * b
inline Vector sum(const Vector& a, double factor, const Vector& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

inline Vector scaled(double factor, const Vector& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

inline double lengthOf(const Vector& a)
{
  return std::hypot(a[0], a[1], a[2]);
}

/// @returns the vector at length 1, or the x axis for one without direction
inline Vector directionOf(const Vector& a)
{
  const double length = lengthOf(a);
  return length > 0.0 ? Vector{ a[0] / length, a[1] / length, a[2] / length }
                      : Vector{ 1.0, 0.0, 0.0 };
}

} // namespace isopoint

#endif
