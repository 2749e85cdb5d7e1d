// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/PolynomialFit.h"

#include "Core/Fit/NormalEquations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

/// The error of a polynomial, from the nearest samples to the origin: others have small weights.
struct ErrorEstimate
{
  /// Leave-one-out RMS, at least the error of values; NaN if one sample determines a coefficient.
  double residual;
  double valueEffect; // of these residuals on the value at the origin: the root of a sum of squares
  double slopeEffect; // on the gradient there
};

template <int Degree>
ErrorEstimate estimateError(const NormalEquations<Degree>& equations, const Polynomial& polynomial,
  const FrameSamples& samples, const FrameWeights& weights)
{
  constexpr std::size_t nearest = FrameSamples::nearest;
  using Numbers = Pack<nearest>;
  const Numbers weight = weights.first<nearest>();
  const Numbers x = samples.x.first<nearest>();
  const Numbers y = samples.y.first<nearest>();
  const Numbers z = samples.z.first<nearest>();
  auto reduced = equations.products(x, y, z);
  equations.reduce(polynomial.degree, reduced);
  const auto effectOn = [&](const auto& unit)
  {
    Numbers effect = Numbers::Zero();
    for (std::size_t i = 0; i < coefficientCount(polynomial.degree); ++i)
    {
      effect += unit(i) * reduced[i];
    }
    return effect;
  };
  const auto ofSamples = [&](std::size_t i) -> const Numbers& { return reduced[i]; };
  const Numbers rest = 1.0 - weight * effectOn(ofSamples); // determinant's share without the sample
  const Numbers residual =
    weight * (samples.value.first<nearest>() - polynomial.valueAt(x, y, z)) / rest;
  // The value and the slopes, side by side.
  std::array<Lanes, NormalEquations<Degree>::size> units;
  units.fill(Lanes::Zero());
  for (std::size_t i = 0; i < laneCount; ++i)
  {
    units[i][i] = 1.0;
  }
  equations.reduce(polynomial.degree, units);
  std::array<double, laneCount> effects; // of all samples on them
  for (std::size_t i = 0; i < laneCount; ++i)
  {
    effects[i] =
      sumOfSquares(Numbers(weight * effectOn([&](std::size_t j) { return units[j][i]; })));
  }
  // If the other samples determine less, a residual is only rounding.
  const bool isDetermined = (rest > minPivot).all();
  const double meanSquare = isDetermined ? sumOfSquares(residual) / sumOfSquares(weight)
                                         : std::numeric_limits<double>::quiet_NaN();
  // std::max() keeps NaN as its first argument.
  return { std::max(std::sqrt(meanSquare), samples.valueError), std::sqrt(effects[0]),
    std::sqrt(effects[1] + effects[2] + effects[3]) };
}

/// The zero of a polynomial, if it holds there.
std::optional<Vector> zeroOf(const Polynomial& polynomial, const Vector& increasing)
{
  constexpr double maxMove = 0.5; // of the edge's length
  const std::optional<Vector> zero = increasesAlong(increasing, polynomial.gradientAt({}))
                                       ? zeroNear(polynomial, maxMove * lengthOf(increasing))
                                       : std::nullopt;
  return zero && increasesAlong(increasing, polynomial.gradientAt(*zero)) ? zero : std::nullopt;
}

template <int Degree>
std::optional<PolynomialFit> fitOfDegree(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing)
{
  const NormalEquations<Degree> equations(samples, weights);
  if (equations.determinedDegree() < Degree)
  {
    return std::nullopt;
  }
  PolynomialFit fit;
  fit.polynomial = equations.solution(Degree);
  const ErrorEstimate error = estimateError(equations, fit.polynomial, samples, weights);
  fit.relativeResidual = error.residual / lengthOf(fit.polynomial.gradientAt({}));
  fit.zeroError = fit.relativeResidual * error.valueEffect;
  fit.directionError = fit.relativeResidual * error.slopeEffect;
  if (!std::isfinite(fit.zeroError))
  {
    return std::nullopt;
  }
  fit.zero = zeroOf(fit.polynomial, increasing);
  return fit;
}

} // namespace

bool increasesAlong(const Vector& increasing, const Vector& gradient)
{
  constexpr double minCosine = -0.2;
  return dot(gradient, increasing) >
         minCosine * std::sqrt(dot(gradient, gradient) * dot(increasing, increasing));
}

bool areEnough(std::size_t sampleCount, int degree)
{
  return 4 * sampleCount >= 5 * coefficientCount(degree);
}

std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing, int degree)
{
  if (!areEnough(samples.count(), degree))
  {
    return std::nullopt;
  }
  return degree == 2 ? fitOfDegree<2>(samples, weights, increasing)
                     : fitOfDegree<3>(samples, weights, increasing);
}

std::optional<Polynomial> leastSquares(
  const FrameSamples& samples, const FrameWeights& weights, int degree)
{
  const auto solutionOf = [degree](const auto& equations)
  {
    return equations.determinedDegree() == degree
             ? std::optional<Polynomial>(equations.solution(degree))
             : std::nullopt;
  };
  if (!areEnough(samples.count(), degree))
  {
    return std::nullopt;
  }
  switch (degree)
  {
    case 1:
      return solutionOf(NormalEquations<1>(samples, weights));
    case 2:
      return solutionOf(NormalEquations<2>(samples, weights));
    default:
      return solutionOf(NormalEquations<3>(samples, weights));
  }
}

} // namespace isopoint
