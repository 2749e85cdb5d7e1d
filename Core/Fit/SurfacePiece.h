// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SurfacePiece_h
#define isopoint_SurfacePiece_h

#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

#include <vector>

namespace isopoint
{

/// One of the smooth pieces that meet at a crease: where a function of degree two is zero.
struct SurfacePiece
{
  Vector place; // on it
  Vector slope; // there, of length 1
  Hessian bend; // over the slope

  /// The piece that a fitted isopoint is on.
  explicit SurfacePiece(const LocalFit& fit);

  /// The tangent plane of another piece that an isopoint's fit knows.
  SurfacePiece(const Vector& isopoint, const CreasePlane& plane);

  double valueAt(const Vector& position) const;
  Vector slopeAt(const Vector& position) const;
};

/// The place near another one where two or three pieces meet: Newton's steps of least length. Not
/// finite where they are parallel.
Vector meetingOf(const std::vector<SurfacePiece>& pieces, const Vector& from);

} // namespace isopoint

#endif
