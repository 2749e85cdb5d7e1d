// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseFit_h
#define isopoint_CreaseFit_h

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Fit/Polynomial.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The largest (`sense` 1) or the smallest (`sense` -1) of polynomials of degree one or two: a
/// field with a crease where two of them are equal, or a corner where three are.
struct CreaseFit
{
  double sense = 1.0;
  std::vector<Polynomial> pieces;
  /// Root mean square, weighted, as by generalized cross-validation [GHW79]: that of samples left
  /// out of the fit, on average.
  double residual = 0.0;

  /// The piece that counts at a place.
  std::size_t pieceAt(const Vector& place) const;

  /// The least slope of a piece at the origin.
  double leastSlope() const;

  /// Whether any two pieces meet at an angle of 25 degrees or more.
  bool isSharp() const;
};

/// The place on a crease fit's surface that an isopoint moves to.
struct CreasePoint
{
  Vector zero;
  Vector gradient; // of the piece there
  Hessian hessian;
  std::vector<CreasePlane> creases; // of the other pieces, the nearest along the piece first
};

/// The best fit of two to four pieces, by alternation between which sample belongs to which piece
/// and least squares [MB09]. Two pieces start as halves of the samples, cut across the direction in
/// which the residuals of one bend most; then the piece of the largest residuals is cut likewise.
/// In the end pieces whose samples determine it are of degree two, if that is better.
/// @returns nothing where pieces have too few samples. Complexity: O(samples)
std::optional<CreaseFit> fitCrease(const FrameSamples& samples, const FrameWeights& weights);

/// The residual of the polynomial of the highest degree that the samples determine, as that of a
/// crease fit of one piece; infinite if they determine none.
double polynomialResidual(const FrameSamples& samples, const FrameWeights& weights);

/// The nearest zero of one piece that belongs to the whole surface, or else of the crease between
/// two; nothing if that is farther than a distance.
std::optional<CreasePoint> zeroNear(const CreaseFit& fit, double farthest);

} // namespace isopoint

#endif
