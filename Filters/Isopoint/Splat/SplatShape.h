// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatShape_h
#define isopoint_SplatShape_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/TangentCell.h"

#include <array>

namespace isopoint
{

/// The half-axes of an ellipse in a tangent plane, axis1 the longer.
struct Ellipse
{
  Vector axis1;
  Vector axis2;
};

/// How much a surface bends in a direction: one over its radius.
struct Curvature
{
  Vector direction; // of length 1
  double value;     // not negative
};

/// Whether a Hessian determines the curvature; it is 0 where no fit does.
inline bool isBendKnown(const Hessian& hessian)
{
  return hessian != Hessian{};
}

/// The magnitudes of the curvatures in the two directions of a cell's plane in which the surface
/// bends least and most, in this order.
/// @param hessian, gradientLength of the field (see LocalFit); a Hessian of 0 for a plane
std::array<Curvature, 2> principalCurvatures(
  const TangentCell& cell, const Hessian& hessian, double gradientLength);

/// The ellipse around a cell whose rim departs least from the curved surface: long where the
/// surface is flat, short where it bends. It is a circle where the curvature is not known.
/// @param normal of length 1
/// @param hessian, gradientLength of the field (see LocalFit); a Hessian of 0 where the curvature
/// is not known
Ellipse fitEllipse(
  const TangentCell& cell, const Vector& normal, const Hessian& hessian, double gradientLength);

} // namespace isopoint

#endif
