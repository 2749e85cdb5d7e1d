// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatShape_h
#define isopoint_SplatShape_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/TangentCell.h"

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

/// How a surface bends along a cell's plane: one over its radius, in a direction of length 1.
/// @param hessian, gradient of the field (see LocalFit)
/// @param unit of length of the cell
PlaneForm curvatureOf(
  const TangentCell& cell, const Hessian& hessian, const Vector& gradient, double unit);

/// The two directions, orthogonal to each other, that of the least magnitude first.
std::array<PrincipalDirection, 2> principalDirections(const PlaneForm& form);

/// An ellipse in a cell's plane, around its origin.
struct Ellipse
{
  double x; // the direction of its longer axis, of length 1
  double y;
  double major; // half the longer axis
  double minor;
};

/// The ellipse around a cell whose rim departs least from the curved surface: long where the
/// surface is flat, short where it bends.
/// @param curvatures of the surface, in the cell's unit; nothing if they are not known: then it is
/// a circle
Ellipse ellipseAround(const TangentCell& cell, const std::array<PrincipalDirection, 2>* curvatures);

} // namespace isopoint

#endif
