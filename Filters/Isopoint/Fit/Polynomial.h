// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Polynomial_h
#define isopoint_Polynomial_h

#include "Isopoint/Base/Vector.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// How many coefficients a polynomial of three variables has: 4, 10, 20 of degree 1, 2, 3.
constexpr std::size_t coefficientCount(int degree)
{
  return static_cast<std::size_t>((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// A polynomial of degree one to three. Its coefficients are those of 1; x, y, z; x^2, y^2, z^2, x
/// y, x z, y z; x^3, y^3, z^3, x^2 y, x^2 z, y^2 x, y^2 z, z^2 x, z^2 y, x y z; those of a higher
/// degree than its own are 0.
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
  Vector gradientAt(const Vector& p) const;
  Hessian hessianAt(const Vector& p) const;
};

} // namespace isopoint

#endif
