// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Tetrahedra/SphereFunction.h"

#include <CGAL/MP_Float.h>

#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

/// Bounds the error of the polynomials below, including the evaluation of F, relative to the sum of
/// the magnitudes of their terms. Each has at most 40 roundings.
constexpr double relativeError = 64.0 * 0.5 * std::numeric_limits<double>::epsilon();

/// An error of d up to this share of d is harmless.
constexpr double toleratedShare = 1.0 / 16.0;

/// A polynomial, and the sum of the magnitudes of its terms.
struct Bounded
{
  double value;
  double magnitude;
};

Bounded bounded(double value)
{
  return { value, std::abs(value) };
}

Bounded operator+(const Bounded& a, const Bounded& b)
{
  return { a.value + b.value, a.magnitude + b.magnitude };
}

Bounded operator-(const Bounded& a, const Bounded& b)
{
  return { a.value - b.value, a.magnitude + b.magnitude };
}

Bounded operator*(const Bounded& a, const Bounded& b)
{
  return { a.value * b.value, a.magnitude * b.magnitude };
}

template <class T>
using Triple = std::array<T, 3>;

template <class T>
Triple<T> crossOf(const Triple<T>& a, const Triple<T>& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

template <class T>
T dotOf(const Triple<T>& a, const Triple<T>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Twice F of the ball through 0, a1, a2 and a3: d = 2 det(a1, a2, a3), n = 2 d times the center.
template <class T>
struct Ball
{
  T d;
  Triple<T> n;
};

/// @param a3 another corner or, unless `isCorner`, a direction orthogonal to the center
template <class T>
Ball<T> ballOf(const Triple<T>& a1, const Triple<T>& a2, const Triple<T>& a3, bool isCorner)
{
  const Triple<T> c1 = crossOf(a2, a3);
  const Triple<T> c2 = crossOf(a3, a1);
  const Triple<T> c3 = crossOf(a1, a2);
  const T h1 = dotOf(a1, a1);
  const T h2 = dotOf(a2, a2);
  const T d = dotOf(a1, c1);
  Ball<T> ball{ d + d, {} };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ball.n[axis] = h1 * c1[axis] + h2 * c2[axis];
    if (isCorner)
    {
      ball.n[axis] = ball.n[axis] + dotOf(a3, a3) * c3[axis];
    }
  }
  return ball;
}

/// A power of two that scales the largest difference from the first corner to about 1, if possible.
template <std::size_t Count>
double scaleOf(const std::array<Vector, Count>& corners)
{
  double largest = 0.0;
  for (const Vector& corner : corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // Halves, to avoid overflow of the difference.
      largest = std::max(largest, std::abs(0.5 * corner[axis] - 0.5 * corners[0][axis]));
    }
  }
  constexpr int maxDigits = 1000;
  return largest > 0.0
           ? std::ldexp(1.0, std::max(-maxDigits, std::min(maxDigits, -std::ilogb(largest))))
           : 1.0;
}

Triple<Bounded> offset(const Vector& from, const Vector& to, double scale)
{
  Triple<Bounded> result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result[axis] = bounded(scale * to[axis] - scale * from[axis]);
  }
  return result;
}

using Exact = CGAL::MP_Float;

Triple<Exact> exactOffset(const Vector& from, const Vector& to, double scale)
{
  Triple<Exact> result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result[axis] = (Exact(to[axis]) - Exact(from[axis])) * Exact(scale);
  }
  return result;
}

SphereFunction functionOf(const Vector& origin, double scale, const Ball<Bounded>& ball)
{
  Vector n;
  Vector nError;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    n[axis] = ball.n[axis].value;
    nError[axis] = relativeError * ball.n[axis].magnitude;
  }
  return { origin, scale, ball.d.value, relativeError * ball.d.magnitude, n, nError };
}

/// The function of a ball whose exact numbers are rounded once.
SphereFunction functionOf(const Vector& origin, double scale, const Ball<Exact>& ball)
{
  return functionOf(origin, scale,
    Ball<Bounded>{ bounded(CGAL::to_double(ball.d)),
      { bounded(CGAL::to_double(ball.n[0])), bounded(CGAL::to_double(ball.n[1])),
        bounded(CGAL::to_double(ball.n[2])) } });
}

bool isWellKnown(const Bounded& d)
{
  return relativeError * d.magnitude <= toleratedShare * d.value;
}

} // namespace

SphereFunction ballAround(const TetrahedronCorners& corners)
{
  const Vector& origin = corners[0];
  const double scale = scaleOf(corners);
  const Ball<Bounded> ball = ballOf(offset(origin, corners[1], scale),
    offset(origin, corners[2], scale), offset(origin, corners[3], scale), true);
  if (isWellKnown(ball.d))
  {
    return functionOf(origin, scale, ball);
  }
  return functionOf(origin, scale,
    ballOf(exactOffset(origin, corners[1], scale), exactOffset(origin, corners[2], scale),
      exactOffset(origin, corners[3], scale), true));
}

SphereFunction halfSpaceBeyond(const HullFacetCorners& corners)
{
  const Vector& origin = corners[0];
  const double scale = scaleOf(corners);
  const Triple<Bounded> normal =
    crossOf(offset(origin, corners[1], scale), offset(origin, corners[2], scale));
  const Bounded length = dotOf(normal, normal);
  if (isWellKnown(length))
  {
    return functionOf(origin, scale, Ball<Bounded>{ bounded(0.0), normal });
  }
  return functionOf(origin, scale,
    Ball<Exact>{ Exact(0),
      crossOf(exactOffset(origin, corners[1], scale), exactOffset(origin, corners[2], scale)) });
}

SphereFunction ballThrough(const HullFacetCorners& corners)
{
  const Vector& origin = corners[0];
  const double scale = scaleOf(corners);
  const Triple<Bounded> a1 = offset(origin, corners[1], scale);
  const Triple<Bounded> a2 = offset(origin, corners[2], scale);
  const Ball<Bounded> ball = ballOf(a1, a2, crossOf(a1, a2), false);
  if (isWellKnown(ball.d))
  {
    return functionOf(origin, scale, ball);
  }
  const Triple<Exact> exact1 = exactOffset(origin, corners[1], scale);
  const Triple<Exact> exact2 = exactOffset(origin, corners[2], scale);
  return functionOf(origin, scale, ballOf(exact1, exact2, crossOf(exact1, exact2), false));
}

} // namespace isopoint
