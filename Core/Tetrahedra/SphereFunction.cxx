// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Tetrahedra/SphereFunction.h"

#include <CGAL/MP_Float.h>

#include <cstddef>
#include <limits>
#include <type_traits>

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
  T size; // positive unless the corners are degenerate
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
  Ball<T> ball{ d + d, {}, d + d };
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

using Exact = CGAL::MP_Float;

/// The offsets of corners from the first one, in numbers of type T.
template <class T, std::size_t Count>
std::array<Triple<T>, Count> offsetsOf(const std::array<Vector, Count>& corners, double scale)
{
  std::array<Triple<T>, Count> offsets{};
  for (std::size_t i = 1; i < Count; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double to = corners[i][axis];
      const double from = corners[0][axis];
      if constexpr (std::is_same_v<T, Exact>)
      {
        offsets[i][axis] = (Exact(to) - Exact(from)) * Exact(scale);
      }
      else
      {
        offsets[i][axis] = bounded(scale * to - scale * from);
      }
    }
  }
  return offsets;
}

/// Exact numbers, rounded once.
Ball<Bounded> rounded(const Ball<Exact>& ball)
{
  const auto round = [](const Exact& number) { return bounded(CGAL::to_double(number)); };
  return { round(ball.d), { round(ball.n[0]), round(ball.n[1]), round(ball.n[2]) }, {} };
}

/// The function of a ball: in doubles if these tell its size, else in exact numbers.
/// @param makeBall(offsets) the ball through corners, given offsetsOf() them
template <std::size_t Count, class MakeBall>
SphereFunction functionOf(const std::array<Vector, Count>& corners, const MakeBall& makeBall)
{
  const double scale = scaleOf(corners);
  Ball<Bounded> ball = makeBall(offsetsOf<Bounded>(corners, scale));
  if (!(relativeError * ball.size.magnitude <= toleratedShare * ball.size.value))
  {
    ball = rounded(makeBall(offsetsOf<Exact>(corners, scale)));
  }
  Vector n;
  Vector nError;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    n[axis] = ball.n[axis].value;
    nError[axis] = relativeError * ball.n[axis].magnitude;
  }
  return { corners[0], scale, ball.d.value, relativeError * ball.d.magnitude, n, nError };
}

} // namespace

SphereFunction ballAround(const TetrahedronCorners& corners)
{
  return functionOf(corners, [](const auto& a) { return ballOf(a[1], a[2], a[3], true); });
}

SphereFunction halfSpaceBeyond(const HullFacetCorners& corners)
{
  return functionOf(corners,
    [](const auto& a)
    {
      const auto normal = crossOf(a[1], a[2]);
      using T = std::decay_t<decltype(normal[0])>;
      return Ball<T>{ T{}, normal, dotOf(normal, normal) };
    });
}

SphereFunction ballThrough(const HullFacetCorners& corners)
{
  return functionOf(
    corners, [](const auto& a) { return ballOf(a[1], a[2], crossOf(a[1], a[2]), false); });
}

} // namespace isopoint
