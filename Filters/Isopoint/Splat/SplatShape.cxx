// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatShape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isopoint
{
namespace
{

constexpr double pi = 3.14159265358979323846;

/// A symmetric form of two variables.
struct Form
{
  double xx;
  double xy;
  double yy;

  /// The angle of the direction in which its value is of the least magnitude.
  double flattestAngle() const
  {
    const double angle = 0.5 * std::atan2(2.0 * this->xy, this->xx - this->yy);
    return std::abs(this->at(angle)) <= std::abs(this->at(angle + 0.5 * pi)) ? angle
                                                                             : angle + 0.5 * pi;
  }

  double at(double angle) const
  {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return this->xx * c * c + 2.0 * this->xy * c * s + this->yy * s * s;
  }
};

double second(const Hessian& hessian, const Vector& a, const Vector& b)
{
  return hessian[0] * a[0] * b[0] + hessian[1] * a[1] * b[1] + hessian[2] * a[2] * b[2] +
         hessian[3] * (a[0] * b[1] + a[1] * b[0]) + hessian[4] * (a[0] * b[2] + a[2] * b[0]) +
         hessian[5] * (a[1] * b[2] + a[2] * b[1]);
}

Form curvatureOf(const TangentCell& cell, const Hessian& hessian, double gradientLength)
{
  const bool isBent = gradientLength > 0.0 && std::isfinite(gradientLength);
  const auto along = [&](const Vector& a, const Vector& b)
  { return isBent ? second(hessian, a, b) / gradientLength : 0.0; };
  return { along(cell.first(), cell.first()), along(cell.first(), cell.second()),
    along(cell.second(), cell.second()) };
}

/// The second moments of a cell's corners, turned so that the flattest direction is the longest.
Form shapeOf(const TangentCell& cell)
{
  Form form{ 0.0, 0.0, 0.0 };
  for (const TangentCell::Corner& corner : cell.corners())
  {
    form.xx += corner.y * corner.y;
    form.xy -= corner.x * corner.y;
    form.yy += corner.x * corner.x;
  }
  return form;
}

} // namespace

std::array<Curvature, 2> principalCurvatures(
  const TangentCell& cell, const Hessian& hessian, double gradientLength)
{
  const Form form = curvatureOf(cell, hessian, gradientLength);
  const double flattest = form.flattestAngle();
  std::array<Curvature, 2> result;
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    const double angle = flattest + 0.5 * pi * static_cast<double>(i);
    result[i] = { sum(scaled(std::cos(angle), cell.first()), std::sin(angle), cell.second()),
      std::abs(form.at(angle)) };
  }
  return result;
}

Ellipse fitEllipse(
  const TangentCell& cell, const Vector& normal, const Hessian& hessian, double gradientLength)
{
  const Form curvature = curvatureOf(cell, hessian, gradientLength);
  Ellipse best{};
  double leastCost = std::numeric_limits<double>::infinity();
  const double reach = cell.reach();
  // Where the curvature is not known, ellipses that are as long as the cell leave gaps.
  const bool mayBeLong = isBendKnown(hessian);
  for (const double angle : { shapeOf(cell).flattestAngle(), curvature.flattestAngle() })
  {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (const double aspect : { 1.0, 1.25, 1.6, 2.0 })
    {
      if (aspect > 1.0 && !mayBeLong)
      {
        break;
      }
      double minor = 0.0;
      for (const TangentCell::Corner& corner : cell.corners())
      {
        minor = std::max(
          minor, std::hypot((c * corner.x + s * corner.y) / aspect, c * corner.y - s * corner.x));
      }
      const double major = aspect * minor;
      const double departure = 0.5 * std::max(std::abs(curvature.at(angle)) * major * major,
                                       std::abs(curvature.at(angle + 0.5 * pi)) * minor * minor);
      // In units of lengths; the area decides where both are flat.
      constexpr double areaShare = 0.05;
      const double cost = departure + areaShare * major * minor / reach;
      if (cost < leastCost)
      {
        leastCost = cost;
        best.axis1 = sum(scaled(major * c, cell.first()), major * s, cell.second());
        best.axis2 = scaled(minor, cross(normal, directionOf(best.axis1)));
      }
    }
  }
  return best;
}

} // namespace isopoint
