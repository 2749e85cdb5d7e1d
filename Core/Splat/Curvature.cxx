// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/Curvature.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{
namespace
{

double second(const Hessian& hessian, const Vector& a, const Vector& b)
{
  return hessian[0] * a[0] * b[0] + hessian[1] * a[1] * b[1] + hessian[2] * a[2] * b[2] +
         hessian[3] * (a[0] * b[1] + a[1] * b[0]) + hessian[4] * (a[0] * b[2] + a[2] * b[0]) +
         hessian[5] * (a[1] * b[2] + a[2] * b[1]);
}

double valueAt(const PlaneForm& form, double x, double y)
{
  return form.xx * x * x + 2.0 * form.xy * x * y + form.yy * y * y;
}

PrincipalDirection largestDirection(const PlaneForm& form)
{
  const double half = 0.5 * (form.xx - form.yy);
  const double amplitude = std::sqrt(half * half + form.xy * form.xy);
  const double cosine = amplitude > 0.0 ? half / amplitude : 1.0; // of twice the angle
  const double x = std::sqrt(std::max(0.0, 0.5 + 0.5 * cosine));
  const double y = std::copysign(std::sqrt(std::max(0.0, 0.5 - 0.5 * cosine)), form.xy);
  return { x, y, 0.5 * (form.xx + form.yy) + amplitude };
}

} // namespace

PlaneForm curvatureOf(
  const TangentFrame& frame, const Hessian& hessian, const Vector& gradient, double unit)
{
  const double scale = unit / lengthOf(gradient);
  const PlaneForm form{ scale * second(hessian, frame.first, frame.first),
    scale * second(hessian, frame.first, frame.second),
    scale * second(hessian, frame.second, frame.second) };
  const double size = std::abs(form.xx) + std::abs(form.xy) + std::abs(form.yy);
  return std::isfinite(size) ? form : PlaneForm{};
}

std::array<PrincipalDirection, 2> principalDirections(const PlaneForm& form)
{
  const PrincipalDirection largest = largestDirection(form);
  const PrincipalDirection least{ -largest.y, largest.x, valueAt(form, -largest.y, largest.x) };
  return std::abs(largest.value) <= std::abs(least.value)
           ? std::array<PrincipalDirection, 2>{ largest, least }
           : std::array<PrincipalDirection, 2>{ least, largest };
}

} // namespace isopoint
