// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_PolynomialFit_h
#define isopoint_PolynomialFit_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/FrameSamples.h"
#include "Isopoint/Fit/NormalEquations.h"
#include "Isopoint/Fit/Polynomial.h"

#include <cstddef>
#include <optional>

namespace isopoint
{

/// A polynomial fitted around an isopoint, and where it is zero.
struct PolynomialFit
{
  Polynomial polynomial;
  Vector zero;          // the nearest place along gradients, in the frame
  Vector gradient;      // there
  double move;          // the distance of the zero from the origin
  double standardError; // of the zero along the gradient
  double residual;      // of the values nearest to the origin, left out of the fit one at a time
};

/// The nearest zero of a polynomial from the origin along gradients (Newton's method), unless it is
/// farther than a distance or is not found in a few steps.
std::optional<Vector> zeroNear(const Polynomial& polynomial, double farthest);

/// The fit of the highest degree that holds, down to two: the samples determine it, its gradient
/// does not contradict the edge, and its zero is no farther than half the edge's length.
/// @param increasing the edge, from the end below the isovalue to the other one
template <int Degree>
std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing);

/// Whether a gradient does not contradict the edge, which may run along a surface that bends.
bool increasesAlong(const Vector& increasing, const Vector& gradient);

} // namespace isopoint

#endif
