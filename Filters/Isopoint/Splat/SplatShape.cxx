// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatShape.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The direction in which a form is largest.
PrincipalDirection largestDirection(const PlaneForm& form)
{
  const double half = 0.5 * (form.xx - form.yy);
  const double amplitude = std::sqrt(half * half + form.xy * form.xy);
  const double cosine = amplitude > 0.0 ? half / amplitude : 1.0; // of twice the angle
  const double x = std::sqrt(std::max(0.0, 0.5 + 0.5 * cosine));
  const double y = std::copysign(std::sqrt(std::max(0.0, 0.5 - 0.5 * cosine)), form.xy);
  return { x, y, 0.5 * (form.xx + form.yy) + amplitude };
}

/// The second moments of a cell's rim about its origin, but for a factor. Unlike sums over corners,
/// they change little where a small change of the cell adds a corner.
PlaneForm momentsOf(const TangentCell& cell)
{
  PlaneForm form;
  const TangentCell::Corner* previous = cell.end() - 1;
  for (const TangentCell::Corner& corner : cell)
  {
    const double alongX = corner.x - previous->x;
    const double alongY = corner.y - previous->y;
    const double length = std::sqrt(alongX * alongX + alongY * alongY);
    const double x = previous->x + corner.x;
    const double y = previous->y + corner.y;
    form.xx += length * (x * x + previous->x * previous->x + corner.x * corner.x);
    form.xy += length * (x * y + previous->x * previous->y + corner.x * corner.y);
    form.yy += length * (y * y + previous->y * previous->y + corner.y * corner.y);
    previous = &corner;
  }
  return form;
}

/// The smaller half-axis of the smallest ellipse around a cell of a direction and an aspect.
double minorAround(const TangentCell& cell, double x, double y, double aspect)
{
  double largest = 0.0;
  for (const TangentCell::Corner& corner : cell)
  {
    const double along = (x * corner.x + y * corner.y) / aspect;
    const double across = x * corner.y - y * corner.x;
    largest = std::max(largest, along * along + across * across);
  }
  return std::sqrt(largest);
}

} // namespace

PlaneForm curvatureOf(
  const TangentCell& cell, const Hessian& hessian, const Vector& gradient, double unit)
{
  const double scale = unit / lengthOf(gradient);
  if (!std::isfinite(scale))
  {
    return {};
  }
  return { scale * second(hessian, cell.first(), cell.first()),
    scale * second(hessian, cell.first(), cell.second()),
    scale * second(hessian, cell.second(), cell.second()) };
}

std::array<PrincipalDirection, 2> principalDirections(const PlaneForm& form)
{
  const PrincipalDirection largest = largestDirection(form);
  const PrincipalDirection least{ -largest.y, largest.x, valueAt(form, -largest.y, largest.x) };
  return std::abs(largest.value) <= std::abs(least.value)
           ? std::array<PrincipalDirection, 2>{ largest, least }
           : std::array<PrincipalDirection, 2>{ least, largest };
}

Ellipse ellipseAround(const TangentCell& cell, const std::array<PrincipalDirection, 2>* curvatures)
{
  const PrincipalDirection longest = largestDirection(momentsOf(cell));
  if (!curvatures)
  {
    const double radius = std::sqrt(cell.squaredReach());
    return { longest.x, longest.y, radius, radius };
  }
  const auto& [flattest, steepest] = *curvatures;
  Ellipse best{};
  double leastCost = std::numeric_limits<double>::infinity();
  for (const PrincipalDirection& direction : { longest, flattest })
  {
    const double cosine = direction.x * flattest.x + direction.y * flattest.y;
    const double share = cosine * cosine;
    const double along = share * flattest.value + (1.0 - share) * steepest.value;
    const double across = (1.0 - share) * flattest.value + share * steepest.value;
    for (const double aspect : { 1.0, 1.25, 1.6, 2.0 })
    {
      const double minor = minorAround(cell, direction.x, direction.y, aspect);
      const double major = aspect * minor;
      const double departure =
        0.5 * std::max(std::abs(along) * major * major, std::abs(across) * minor * minor);
      // In units of lengths; the area decides where both are flat.
      constexpr double areaShare = 0.05;
      const double cost = departure + areaShare * major * minor / std::sqrt(cell.squaredReach());
      if (cost < leastCost)
      {
        leastCost = cost;
        best = { direction.x, direction.y, major, minor };
      }
    }
  }
  return best;
}

} // namespace isopoint
