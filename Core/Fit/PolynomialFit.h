// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
  /// The nearest zero from the origin along gradients, if the polynomial holds: its gradients at
  /// the origin and the zero agree with the edge, and the zero is within half the edge's length.
  std::optional<Vector> zero;
  /// The leave-one-out RMS residual of the nearest samples, over the slope at the origin.
  double relativeResidual;
  double zeroError;      // standard error along the gradient
  double directionError; // standard error of the gradient's direction in radians, if small
};

/// Whether a gradient agrees with an edge, with tolerance: the edge may run along a curved surface.
/// @param increasing the edge, from the end below the isovalue to the other
bool increasesAlong(const Vector& increasing, const Vector& gradient);

/// The weighted least-squares polynomial of degree 2 or 3, if samples determine it and its error.
/// @param increasing the edge, from the end below the isovalue to the other
/// Complexity: O(samples)
std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing, int degree);

/// Whether this many samples determine a polynomial and its error.
bool areEnough(std::size_t sampleCount, int degree);

/// The weighted least-squares polynomial of degree 1 to 3, if enough samples determine it.
/// Complexity: O(samples)
std::optional<Polynomial> leastSquares(
  const FrameSamples& samples, const FrameWeights& weights, int degree);

} // namespace isopoint
