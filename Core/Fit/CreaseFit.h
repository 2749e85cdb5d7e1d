// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Fit/Polynomial.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The largest (`sense` 1) or smallest (`sense` -1) of polynomials of degree one or two: a field
/// with a crease where two of them are equal, or a corner where three are.
struct CreaseFit
{
  double sense = 1.0;
  std::vector<Polynomial> pieces;
  /// Weighted RMS by generalized cross-validation [GHW79], an estimate for samples left out.
  double residual = 0.0;

  /// The piece that defines the field at a place.
  std::size_t pieceAt(const Vector& place) const;

  /// The least slope of a piece at the origin.
  double minSlope() const;

  /// Whether any two pieces meet at 25 degrees or more.
  bool isSharp() const;
};

/// The place on a crease fit's surface that an isopoint moves to.
struct CreasePoint
{
  Vector zero;
  Vector gradient; // of the piece there
  Hessian hessian;
  std::vector<CreasePlane> creases; // of the other pieces, nearest along the piece first
};

/// The best fit of two to four pieces, by k-plane clustering [MB09]. The samples are first split
/// across the direction in which the residuals of one piece bend most, later the samples of the
/// piece with the largest residuals. Finally, pieces become quadratic if their samples determine
/// this and it fits better. O(samples)
/// @returns nothing if pieces have too few samples
std::optional<CreaseFit> fitCrease(const FrameSamples& samples, const FrameWeights& weights);

/// The residual, as CreaseFit::residual, of the polynomial of the highest degree that the samples
/// determine; infinite if there is none.
double polynomialResidual(const FrameSamples& samples, const FrameWeights& weights);

/// The nearest zero within a distance of a piece on the fit's surface, or else of a crease.
std::optional<CreasePoint> zeroNear(const CreaseFit& fit, double farthest);

} // namespace isopoint
