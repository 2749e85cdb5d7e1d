// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatShape_h
#define isopoint_SplatShape_h

#include "Isopoint/Splat/TangentCell.h"
#include "Isopoint/Base/Vector.h"

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

/// Whether a hessian tells how the surface bends; it is 0 where no fit does.
inline bool isBendKnown(const std::array<double, 6>& hessian)
{
  return hessian != std::array<double, 6>{};
}

/// In the two directions of a cell's plane in which the surface bends most and least.
/// @param hessian, gradientLength of the field (see LocalFit); a hessian of 0 for a plane
std::array<Curvature, 2> principalCurvatures(
  const TangentCell& cell, const std::array<double, 6>& hessian, double gradientLength);

/// An ellipse around a cell, and of those the one whose rim departs least from the surface that
/// curves as a fit tells: long where the surface is flat, short where it bends. Where the fit tells
/// of no bend it is the circle.
/// @param normal of length 1
/// @param hessian, gradientLength of the field (see LocalFit); a hessian of 0 where nothing is
/// known
Ellipse fitEllipse(const TangentCell& cell, const Vector& normal,
  const std::array<double, 6>& hessian, double gradientLength);

} // namespace isopoint

#endif
