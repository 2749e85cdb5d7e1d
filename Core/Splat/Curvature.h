// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <array>

namespace isopoint
{

/// A quadratic form on a tangent plane.
struct PlaneForm
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

/// A unit vector in a tangent plane along which a form has an extreme value.
struct PrincipalDirection
{
  double x;
  double y;
  double value; // of the form
};

/// The normal curvature of a surface, 1 / radius, as a form on unit vectors of a tangent plane. At
/// a small offset (x, y) the surface is half the form's value above the plane.
PlaneForm curvatureOf(
  const TangentFrame& frame, const Hessian& hessian, const Vector& gradient, double unit);

/// The two orthogonal principal directions, the one of smaller magnitude first.
std::array<PrincipalDirection, 2> principalDirections(const PlaneForm& form);

} // namespace isopoint
