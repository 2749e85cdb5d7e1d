// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialFit_h
#define isopoint_PolynomialFit_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/FrameSamples.h"
#include "Isopoint/Fit/Polynomial.h"

#include <cstddef>
#include <optional>

namespace isopoint
{

/// A polynomial fitted around an isopoint, and where it is zero; in the frame of the samples.
struct PolynomialFit
{
  Polynomial polynomial;
  Vector zero;     // the nearest one from the origin along gradients
  Vector gradient; // there
  double move;     // the distance of the zero from the origin
  /// The root mean square residual of the samples that come first, each left out of the fit, over
  /// the slope of the polynomial.
  double relativeResidual;
  double zeroError; // standard error of the zero along the gradient
  /// Standard error of the gradient's direction in radians, if small.
  double directionError;
};

/// Whether a gradient does not contradict an edge, which may run along a surface that bends.
/// @param increasing the edge, from the end below the isovalue to the other one
bool increasesAlong(const Vector& increasing, const Vector& gradient);

/// The weighted least-squares polynomial of the highest degree, down to two, that holds: the
/// samples determine it, it does not contradict the edge, neither at the origin nor at its zero,
/// and the zero is no farther than half the edge's length.
/// @param highest 2 or 3
/// @param increasing the edge, from the end below the isovalue to the other one
/// Complexity: O(samples)
std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing, int highest);

/// What a polynomial of degree two through the samples next to an edge shows.
struct NearFit
{
  std::optional<PolynomialFit> smooth; // if it describes the field
  bool isNoise = false; // whether it does not even show into which direction values increase
};

/// @param smoothResidual largest relative residual of a polynomial that describes the field
/// Complexity: O(samples)
NearFit fitNear(const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing,
  double smoothResidual);

/// Whether so many samples determine a polynomial and leave residuals that its error can be
/// estimated from.
bool areEnough(std::size_t sampleCount, int degree);

/// The polynomial of a degree from one to three of weighted least squares, unless the samples do
/// not determine it. Complexity: O(samples)
std::optional<Polynomial> leastSquares(
  const FrameSamples& samples, const FrameWeights& weights, int degree);

/// The root of a mean square of residuals, corrected for the degrees of freedom that coefficients
/// take; not a number where there are no more samples than coefficients.
double correctedResidual(double meanSquare, std::size_t sampleCount, std::size_t coefficients);

} // namespace isopoint

#endif
