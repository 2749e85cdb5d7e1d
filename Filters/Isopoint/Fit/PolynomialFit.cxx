// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/PolynomialFit.h"

#include "Isopoint/Fit/NormalEquations.h"
#include "Isopoint/Fit/PolynomialZero.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

double squaredLength(const Vector& a)
{
  return dot(a, a);
}

/// What the samples nearest to the origin show about the error of a polynomial; the effects of the
/// values of other ones, of far smaller weights, are neglected.
struct ErrorEstimate
{
  /// Root mean square, of samples that are left out of the fit one at a time; not a number if one
  /// of them alone determines a coefficient.
  double residual;
  double valueEffect; // of such residuals on the value at the origin: the root of a sum of squares
  double slopeEffect; // on the gradient there
};

template <int Degree>
ErrorEstimate estimateError(const NormalEquations<Degree>& equations, const Polynomial& polynomial,
  const FrameSamples& samples, const FrameWeights& weights)
{
  const std::size_t count = coefficientCount(polynomial.degree);
  std::array<std::array<double, NormalEquations<Degree>::size>, 4> units; // the value, and slopes
  for (std::size_t i = 0; i < units.size(); ++i)
  {
    units[i] = equations.reducedUnit(polynomial.degree, i);
  }
  Lanes squares = Lanes::Zero();
  Lanes weightSquares = Lanes::Zero();
  Lanes leastRest = Lanes::Ones(); // of the determinant without a sample, as a share
  std::array<Lanes, 4> effects;
  effects.fill(Lanes::Zero());
  const std::size_t groups = std::min(samples.groupCount(), FrameSamples::nearest / laneCount);
  for (std::size_t group = 0; group < groups; ++group)
  {
    const Lanes& weight = weights[group];
    const Lanes& x = samples.x[group];
    const Lanes& y = samples.y[group];
    const Lanes& z = samples.z[group];
    const auto reduced = equations.reduced(polynomial.degree, x, y, z);
    Lanes leverage = Lanes::Zero();
    std::array<Lanes, 4> effect;
    effect.fill(Lanes::Zero());
    for (std::size_t i = 0; i < count; ++i)
    {
      leverage += reduced[i] * reduced[i];
      for (std::size_t unit = 0; unit < units.size(); ++unit)
      {
        effect[unit] += units[unit][i] * reduced[i];
      }
    }
    const Lanes rest = 1.0 - weight * leverage;
    const Lanes residual = weight * (samples.value[group] - polynomial.valueAt(x, y, z)) / rest;
    leastRest = leastRest.min(rest);
    squares += residual * residual;
    weightSquares += weight * weight;
    for (std::size_t unit = 0; unit < units.size(); ++unit)
    {
      effects[unit] += (weight * effect[unit]) * (weight * effect[unit]);
    }
  }
  // The residual of a sample without which the others determine less is rounding alone.
  const double residual = leastRest.minCoeff() > leastPivot
                            ? std::sqrt(sumOf(squares) / sumOf(weightSquares))
                            : std::numeric_limits<double>::quiet_NaN();
  return { residual, std::sqrt(sumOf(effects[0])),
    std::sqrt(sumOf(effects[1]) + sumOf(effects[2]) + sumOf(effects[3])) };
}

/// Sets where a polynomial is zero. @returns whether it holds there
bool moveToZero(const Vector& increasing, PolynomialFit& fit)
{
  constexpr double mostMove = 0.5; // of the edge's length
  const std::optional<Vector> zero =
    increasesAlong(increasing, fit.polynomial.gradientAt({}))
      ? zeroNear(fit.polynomial, mostMove * std::sqrt(squaredLength(increasing)))
      : std::nullopt;
  if (!zero)
  {
    return false;
  }
  fit.zero = *zero;
  fit.gradient = fit.polynomial.gradientAt(*zero);
  fit.move = std::sqrt(squaredLength(*zero));
  return increasesAlong(increasing, fit.gradient);
}

/// See fitPolynomial().
template <int Degree>
std::optional<PolynomialFit> fit(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing)
{
  const NormalEquations<Degree> equations(samples, weights);
  for (int degree = equations.determinedDegree(); degree > 1; --degree)
  {
    PolynomialFit fit;
    fit.polynomial = equations.solution(degree);
    if (!moveToZero(increasing, fit))
    {
      continue;
    }
    const ErrorEstimate error = estimateError(equations, fit.polynomial, samples, weights);
    fit.relativeResidual = error.residual / std::sqrt(squaredLength(fit.gradient));
    fit.zeroError = fit.relativeResidual * error.valueEffect;
    fit.directionError = fit.relativeResidual * error.slopeEffect;
    if (std::isfinite(fit.zeroError))
    {
      return fit;
    }
  }
  return std::nullopt;
}

} // namespace

bool increasesAlong(const Vector& increasing, const Vector& gradient)
{
  constexpr double leastCosine = -0.2;
  return dot(gradient, increasing) >
         leastCosine * std::sqrt(squaredLength(gradient) * squaredLength(increasing));
}

NearFit fitNear(const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing,
  double smoothResidual)
{
  NearFit near;
  if (!areEnough(samples.count(), 2))
  {
    return near;
  }
  const NormalEquations<2> equations(samples, weights);
  if (equations.determinedDegree() < 2)
  {
    return near;
  }
  PolynomialFit fit{};
  fit.polynomial = equations.solution(2);
  const ErrorEstimate error = estimateError(equations, fit.polynomial, samples, weights);
  fit.relativeResidual = error.residual / std::sqrt(squaredLength(fit.polynomial.gradientAt({})));
  if (fit.relativeResidual <= smoothResidual)
  {
    if (moveToZero(increasing, fit))
    {
      near.smooth = fit;
    }
    return near;
  }
  constexpr double mostDirectionError = 1.0;
  near.isNoise = fit.relativeResidual * error.slopeEffect > mostDirectionError;
  return near;
}

bool areEnough(std::size_t sampleCount, int degree)
{
  return 4 * sampleCount >= 5 * coefficientCount(degree);
}

std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing, int highest)
{
  if (highest > 2 && areEnough(samples.count(), 3))
  {
    return fit<3>(samples, weights, increasing);
  }
  return areEnough(samples.count(), 2) ? fit<2>(samples, weights, increasing) : std::nullopt;
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

double correctedResidual(double meanSquare, std::size_t sampleCount, std::size_t coefficients)
{
  const auto count = static_cast<double>(sampleCount);
  return std::sqrt(count / (count - static_cast<double>(coefficients)) * meanSquare);
}

} // namespace isopoint
