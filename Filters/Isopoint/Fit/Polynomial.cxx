// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/Polynomial.h"

namespace isopoint
{

Vector Polynomial::gradientAt(const Vector& p) const
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

Hessian Polynomial::hessianAt(const Vector& p) const
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

} // namespace isopoint
