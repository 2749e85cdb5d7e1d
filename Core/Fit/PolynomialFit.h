// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialFit_h
#define isopoint_PolynomialFit_h

#include "Core/Base/Vector.h"
#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/Polynomial.h"

#include <cstddef>
#include <optional>

namespace isopoint
{

/// A polynomial fitted around an isopoint, in the frame of the samples.
struct PolynomialFit
{
  Polynomial polynomial;
  /// The nearest zero from the origin along gradients, if the polynomial holds: it does not
  /// contradict the edge, neither at the origin nor there, and that is no farther than half the
  /// edge's length.
  std::optional<Vector> zero;
  /// The root mean square residual of the samples that come first, each left out of the fit, over
  /// the slope of the polynomial at the origin.
  double relativeResidual;
  double zeroError;      // standard error of the zero along the gradient
  double directionError; // standard error of the gradient's direction in radians, if small
};

/// Whether a gradient does not contradict an edge, which may run along a surface that bends.
/// @param increasing the edge, from the end below the isovalue to the other one
bool increasesAlong(const Vector& increasing, const Vector& gradient);

/// The weighted least-squares polynomial of a degree, 2 or 3, if the samples determine it and show
/// its error.
/// @param increasing the edge, from the end below the isovalue to the other one
/// Complexity: O(samples)
std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing, int degree);

/// Whether this many samples determine a polynomial and leave residuals that its error can be
/// estimated from.
bool areEnough(std::size_t sampleCount, int degree);

/// The polynomial of a degree from one to three of weighted least squares, if the samples are
/// enough and determine it. Complexity: O(samples)
std::optional<Polynomial> leastSquares(
  const FrameSamples& samples, const FrameWeights& weights, int degree);

} // namespace isopoint

#endif
