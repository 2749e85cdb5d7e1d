// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isopoint
{

/// Number of coefficients in three variables: 4, 10, 20 for degree 1, 2, 3.
constexpr std::size_t coefficientCount(int degree)
{
  return static_cast<std::size_t>((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// A polynomial of degree one to three. Coefficients are of 1; x, y, z; x^2, y^2, z^2, x y, x z, y
/// z; x^3, y^3, z^3, x^2 y, x^2 z, y^2 x, y^2 z, z^2 x, z^2 y, x y z. Those above the degree are 0.
struct Polynomial
{
  static constexpr int highestDegree = 3;

  int degree = 1;
  std::array<double, coefficientCount(highestDegree)> coefficients{};

  /// At one place, or at several side by side.
  template <class Number>
  Number valueAt(const Number& x, const Number& y, const Number& z) const
  {
    const auto& c = this->coefficients;
    Number value = c[0] + c[1] * x + c[2] * y + c[3] * z;
    if (this->degree > 1)
    {
      value += x * (c[4] * x + c[7] * y + c[8] * z) + y * (c[5] * y + c[9] * z) + c[6] * z * z;
    }
    if (this->degree > 2)
    {
      value += x * x * (c[10] * x + c[13] * y + c[14] * z) +
               y * y * (c[11] * y + c[15] * x + c[16] * z) +
               z * z * (c[12] * z + c[17] * x + c[18] * y) + c[19] * x * y * z;
    }
    return value;
  }

  double valueAt(const Vector& p) const { return this->valueAt(p[0], p[1], p[2]); }

  Vector gradientAt(const Vector& p) const
  {
    const auto& c = this->coefficients;
    const auto [x, y, z] = p;
    return { c[1] + 2.0 * c[4] * x + c[7] * y + c[8] * z + 3.0 * c[10] * x * x +
               2.0 * x * (c[13] * y + c[14] * z) + c[15] * y * y + c[17] * z * z + c[19] * y * z,
      c[2] + 2.0 * c[5] * y + c[7] * x + c[9] * z + 3.0 * c[11] * y * y +
        2.0 * y * (c[15] * x + c[16] * z) + c[13] * x * x + c[18] * z * z + c[19] * x * z,
      c[3] + 2.0 * c[6] * z + c[8] * x + c[9] * y + 3.0 * c[12] * z * z +
        2.0 * z * (c[17] * x + c[18] * y) + c[14] * x * x + c[16] * y * y + c[19] * x * y };
  }

  Hessian hessianAt(const Vector& p) const
  {
    const auto& c = this->coefficients;
    const auto [x, y, z] = p;
    return { 2.0 * (c[4] + 3.0 * c[10] * x + c[13] * y + c[14] * z),
      2.0 * (c[5] + 3.0 * c[11] * y + c[15] * x + c[16] * z),
      2.0 * (c[6] + 3.0 * c[12] * z + c[17] * x + c[18] * y),
      c[7] + 2.0 * (c[13] * x + c[15] * y) + c[19] * z,
      c[8] + 2.0 * (c[14] * x + c[17] * z) + c[19] * y,
      c[9] + 2.0 * (c[16] * y + c[18] * z) + c[19] * x };
  }
};

/// In units near the edge's length. Newton's next step would be about the square.
constexpr double zeroAccuracy = 1e-6;

/// Newton's method until steps vanish.
/// @param stepAt(place) the next step from a place in the frame of a fit
/// @returns the zero, unless it is farther from the start than a distance or takes too many steps
template <class Step>
std::optional<Vector> followToZero(const Vector& start, double farthest, const Step& stepAt)
{
  constexpr int maxSteps = 8;
  Vector place = start;
  for (int i = 0; i < maxSteps; ++i)
  {
    const Vector step = stepAt(place);
    place += step;
    const Vector offset = place - start;
    if (!(dot(offset, offset) <= farthest * farthest)) // NaN if the slope is 0
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
      return -polynomial.valueAt(place) / dot(gradient, gradient) * gradient;
    });
}

} // namespace isopoint
