// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Curvature_h
#define isopoint_Curvature_h

#include "Core/Base/Vector.h"

#include <array>

namespace isopoint
{

/// A symmetric form of the two coordinates of a tangent plane.
struct PlaneForm
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

/// A direction in a tangent plane, of length 1, in which a form has an extreme value.
struct PrincipalDirection
{
  double x;
  double y;
  double value; // of the form
};

/// How a surface bends along a tangent plane: one over its radius, in a direction of length 1. In a
/// small distance (x, y) it is half the form's value above the plane.
/// @param hessian, gradient of the field (see LocalFit)
/// @param unit of length in the plane
PlaneForm curvatureOf(
  const TangentFrame& frame, const Hessian& hessian, const Vector& gradient, double unit);

/// The two directions, orthogonal to each other, that of the least magnitude first.
std::array<PrincipalDirection, 2> principalDirections(const PlaneForm& form);

} // namespace isopoint

#endif
