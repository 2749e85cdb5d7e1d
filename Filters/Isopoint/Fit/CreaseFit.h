// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseFit_h
#define isopoint_CreaseFit_h

#include "Isopoint/Fit/PolynomialFit.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The largest (`sense` 1) or the smallest (`sense` -1) of polynomials of degree one or two: a
/// field with a crease where two of them are equal, or a corner where three are.
struct CreaseFit
{
  double sense = 1.0;
  std::vector<Polynomial> pieces;
  std::size_t sampleCount = 0;
  double meanSquare = 0.0; // of the residuals, weighted

  double value(const Eigen::Vector3d& p) const;

  /// How many coefficients all pieces have.
  std::size_t coefficients() const;

  /// The root of the residuals' mean square, corrected for the degrees of freedom, over the
  /// smallest gradient of a piece at the origin.
  double relativeResidual() const;

  /// Whether a point on the zero surface of a piece is one of the whole function's, up to a
  /// tolerance
  bool isOnSurface(std::size_t piece, const Eigen::Vector3d& p, double tolerance) const;
};

/// Which fits with creases are wanted.
struct CreaseSearch
{
  double mostRelativeResidual;
  /// Where two affine functions leave more, relative or as a mean square, none is looked for.
  double mostRelativeResidualOfTwo;
  double mostMeanSquareOfTwo;
  bool mayBeCurved; // or are pieces affine
};

/// Fits two, three and four affine functions by alternating between which sample belongs to which
/// and least squares [MB09]. Two start as parts of a single fit's samples, cut across the direction
/// in which its residuals bend most; then the piece of the largest residuals is cut likewise. If
/// pieces may be curved, polynomials of degree two follow, by further alternation, for those of up
/// to three pieces whose samples determine them.
/// @returns the affine ones of smallest residuals for each number of pieces, and the curved ones
/// that follow from them; without those in which a piece has too few samples
/// Complexity: O(samples.size())
std::vector<CreaseFit> fitCreases(
  const std::vector<FrameSample>& samples, const CreaseSearch& search);

} // namespace isopoint

#endif
