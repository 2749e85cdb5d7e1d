// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/PolynomialFit.h"

#include "Isopoint/Fit/NormalEquations.h"
#include "Isopoint/Fit/PolynomialZero.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

/// Of so many samples, nearest to the origin, residuals are taken.
constexpr std::size_t nearestCount = 16;

double squaredLength(const Vector& a)
{
  return dot(a, a);
}

/// The samples of the largest weights and these weights; ties are decided by the samples' order.
struct NearestSamples
{
  FrameSamples samples;
  FrameWeights weights;

  NearestSamples(const FrameSamples& all, const FrameWeights& allWeights)
  {
    std::array<double, FrameSamples::most> distances;
    for (std::size_t i = 0; i < all.count(); ++i)
    {
      distances[i] = FrameSamples::at(all.squaredDistance, i);
    }
    const std::size_t wanted = std::min(nearestCount, all.count());
    const auto last = distances.begin() + static_cast<std::ptrdiff_t>(wanted) - 1;
    std::nth_element(
      distances.begin(), last, distances.begin() + static_cast<std::ptrdiff_t>(all.count()));
    const double limit = *last;
    auto equal = wanted - static_cast<std::size_t>(std::count_if(
                            distances.begin(), last, [&](double d) { return d < limit; }));
    for (std::size_t i = 0; i < all.count(); ++i)
    {
      const double distance = FrameSamples::at(all.squaredDistance, i);
      if (distance < limit || (distance == limit && equal > 0))
      {
        equal -= distance == limit ? 1 : 0;
        const std::size_t at = this->samples.count();
        this->samples.add({ FrameSamples::at(all.x, i), FrameSamples::at(all.y, i),
                            FrameSamples::at(all.z, i) },
          FrameSamples::at(all.value, i));
        FrameSamples::at(this->weights, at) = FrameSamples::at(allWeights, i);
      }
    }
    endWeights(this->samples, this->weights);
  }
};

/// The root mean square of the residuals of samples that are left out of the fit one at a time.
template <int Degree>
double leftOutResidual(const NormalEquations<Degree>& equations, const Polynomial& polynomial,
  const FrameSamples& samples, const FrameWeights& weights)
{
  const double squares = samples.sum(
    [&](std::size_t i)
    {
      const Lanes& x = samples.x[i];
      const Lanes& y = samples.y[i];
      const Lanes& z = samples.z[i];
      const Lanes leverage = weights[i] * equations.leverage(polynomial.degree, x, y, z);
      const Lanes residual =
        weights[i] * (samples.value[i] - polynomial.valueAt(x, y, z)) / (1.0 - leverage);
      return Lanes(residual * residual);
    });
  return std::sqrt(
    squares / samples.sum([&](std::size_t i) { return Lanes(weights[i] * weights[i]); }));
}

/// The sum of the squares of the effects that the samples' values have on a coefficient.
template <int Degree>
double squaredEffects(const NormalEquations<Degree>& equations, int degree, std::size_t coefficient,
  const FrameSamples& samples, const FrameWeights& weights)
{
  const Polynomial influence = equations.influence(degree, coefficient);
  return samples.sum(
    [&](std::size_t i)
    {
      const Lanes effect = weights[i] * influence.valueAt(samples.x[i], samples.y[i], samples.z[i]);
      return Lanes(effect * effect);
    });
}

/// The error of the direction of the gradient at the origin.
/// @param relativeResidual residual over slope
template <int Degree>
double directionErrorOf(const NormalEquations<Degree>& equations, int degree,
  const FrameSamples& samples, const FrameWeights& weights, double relativeResidual)
{
  double effects = 0.0;
  for (const std::size_t slope : { 1, 2, 3 })
  {
    effects += squaredEffects(equations, degree, slope, samples, weights);
  }
  return relativeResidual * std::sqrt(effects);
}

template <int Degree>
void estimateErrors(const NormalEquations<Degree>& equations, const FrameSamples& samples,
  const FrameWeights& weights, PolynomialFit& fit)
{
  const int degree = fit.polynomial.degree;
  const NearestSamples nearest(samples, weights);
  fit.relativeResidual =
    leftOutResidual(equations, fit.polynomial, nearest.samples, nearest.weights) /
    std::sqrt(squaredLength(fit.gradient));
  fit.zeroError = fit.relativeResidual *
    std::sqrt(squaredEffects(equations, degree, 0, nearest.samples, nearest.weights));
  fit.directionError = fit.isAccurate()
    ? 0.0
    : directionErrorOf(equations, degree, nearest.samples, nearest.weights, fit.relativeResidual);
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
    estimateErrors(equations, samples, weights, fit);
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
  const NearestSamples nearest(samples, weights);
  const Vector gradient = fit.polynomial.gradientAt({});
  fit.relativeResidual =
    leftOutResidual(equations, fit.polynomial, nearest.samples, nearest.weights) /
    std::sqrt(squaredLength(gradient));
  if (fit.relativeResidual <= smoothResidual)
  {
    if (moveToZero(increasing, fit))
    {
      near.smooth = fit;
    }
    return near;
  }
  constexpr double mostDirectionError = 1.0;
  near.isNoise = directionErrorOf(equations, 2, nearest.samples, nearest.weights, fit.relativeResidual) > mostDirectionError;
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
