// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

#include <vector>

namespace isopoint
{

/// One of the smooth pieces that meet at a crease: the zeros of a quadratic function.
struct SurfacePiece
{
  Vector place; // on the piece
  Vector slope; // gradient there, of length 1
  Hessian bend; // Hessian over the gradient's length

  /// The piece of a fitted isopoint.
  explicit SurfacePiece(const LocalFit& fit);

  /// The tangent plane of another piece, from an isopoint's fit.
  SurfacePiece(const Vector& isopoint, const CreasePlane& plane);

  double valueAt(const Vector& position) const;
  Vector slopeAt(const Vector& position) const;
};

/// Where two or three pieces meet near `from`, by shortest Newton steps. Not finite if parallel.
Vector meetingOf(const std::vector<SurfacePiece>& pieces, const Vector& from);

} // namespace isopoint
