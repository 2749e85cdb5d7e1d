// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/PolynomialFit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint
{
namespace
{

/// The polynomial at the same place in all lanes.
double squaredLength(const Vector& a)
{
  return dot(a, a);
}

/// Fewer samples leave too few residuals to estimate an error from.
bool areEnough(std::size_t count, int degree)
{
  return 4 * count >= 5 * coefficientCount(degree);
}

/// The samples nearest to the origin.
struct NearestSamples
{
  static constexpr std::size_t most = 16;
  FrameSamples samples;
  FrameWeights weights;

  NearestSamples(const FrameSamples& all, const FrameWeights& allWeights)
  {
    std::array<double, mostFitSamples> distances;
    for (std::size_t i = 0; i < all.count; ++i)
    {
      distances[i] = FrameSamples::at(all.squaredDistance, i);
    }
    double limit = 0.0;
    const std::size_t wanted = std::min(most, all.count);
    const auto last = distances.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
    std::nth_element(distances.begin(), last,
      distances.begin() + static_cast<std::ptrdiff_t>(all.count));
    limit = *last;
    for (const bool isEqual : { false, true })
    {
      for (std::size_t i = 0; i < all.count && this->samples.count < wanted; ++i)
      {
        const double distance = FrameSamples::at(all.squaredDistance, i);
        if (isEqual ? distance == limit : distance < limit)
        {
          const std::size_t at = this->samples.count++;
          FrameSamples::at(this->samples.x, at) = FrameSamples::at(all.x, i);
          FrameSamples::at(this->samples.y, at) = FrameSamples::at(all.y, i);
          FrameSamples::at(this->samples.z, at) = FrameSamples::at(all.z, i);
          FrameSamples::at(this->samples.value, at) = FrameSamples::at(all.value, i);
          FrameSamples::at(this->weights, at) = FrameSamples::at(allWeights, i);
        }
      }
    }
    for (std::size_t at = wanted; at < laneCount * this->samples.groupCount(); ++at)
    {
      FrameSamples::at(this->samples.x, at) = 0.0;
      FrameSamples::at(this->samples.y, at) = 0.0;
      FrameSamples::at(this->samples.z, at) = 0.0;
      FrameSamples::at(this->samples.value, at) = 0.0;
      FrameSamples::at(this->weights, at) = 0.0;
    }
  }
};

template <int Degree>
double residualOf(const NormalEquations<Degree>& equations, const Polynomial& polynomial,
  const NearestSamples& nearest)
{
  Lanes squares = Lanes::Zero();
  Lanes weights = Lanes::Zero();
  const FrameSamples& near = nearest.samples;
  for (std::size_t i = 0; i < near.groupCount(); ++i)
  {
    const Lanes& weight = nearest.weights[i];
    const Lanes leverage =
      weight * equations.leverage(polynomial.degree, near.x[i], near.y[i], near.z[i]);
    const Lanes residual =
      weight * (near.value[i] - polynomial.valueAt(near.x[i], near.y[i], near.z[i])) / (1.0 - leverage);
    squares += residual * residual;
    weights += weight * weight;
  }
  return std::sqrt(sumOf(squares) / sumOf(weights));
}

} // namespace

std::optional<Vector> zeroNear(const Polynomial& polynomial, double farthest)
{
  constexpr int mostSteps = 4;
  constexpr double accuracy = 1e-6;
  Vector place{};
  for (int i = 0; i < mostSteps; ++i)
  {
    const Vector gradient = polynomial.gradientAt(place);
    const double step = -polynomial.valueAt(place) / squaredLength(gradient);
    const Vector next = sum(place, step, gradient);
    if (!(squaredLength(next) <= farthest * farthest)) // nor is it a number, where the gradient is 0
    {
      return std::nullopt;
    }
    const bool isFound = std::abs(step) * std::sqrt(squaredLength(gradient)) <= accuracy * farthest;
    place = next;
    if (isFound)
    {
      return place;
    }
  }
  return std::nullopt;
}

bool increasesAlong(const Vector& increasing, const Vector& gradient)
{
  constexpr double leastCosine = -0.2;
  return dot(gradient, increasing) >
         leastCosine * std::sqrt(squaredLength(gradient) * squaredLength(increasing));
}

template <int Degree>
std::optional<PolynomialFit> fitPolynomial(
  const FrameSamples& samples, const FrameWeights& weights, const Vector& increasing)
{
  if (!areEnough(samples.count, Degree))
  {
    if constexpr (Degree > 2)
    {
      return fitPolynomial<Degree - 1>(samples, weights, increasing);
    }
    else
    {
      return std::nullopt;
    }
  }
  const NormalEquations<Degree> equations(samples, weights);
  const double farthest = 0.5 * std::sqrt(squaredLength(increasing));
  for (int degree = equations.determinedDegree(); degree > 1; --degree)
  {
    PolynomialFit fit;
    fit.polynomial = equations.solution(degree);
    if (!increasesAlong(increasing, fit.polynomial.gradientAt({})))
    {
      continue;
    }
    const std::optional<Vector> zero = zeroNear(fit.polynomial, farthest);
    if (!zero)
    {
      continue;
    }
    fit.zero = *zero;
    fit.gradient = fit.polynomial.gradientAt(fit.zero);
    if (!increasesAlong(increasing, fit.gradient))
    {
      continue;
    }
    fit.move = std::sqrt(squaredLength(fit.zero));
    const NearestSamples nearest(samples, weights);
    fit.residual = residualOf(equations, fit.polynomial, nearest);
    const Polynomial influence = equations.influence(degree);
    Lanes squares = Lanes::Zero();
    for (std::size_t i = 0; i < samples.groupCount(); ++i)
    {
      const Lanes effect = weights[i] * influence.valueAt(samples.x[i], samples.y[i], samples.z[i]);
      squares += effect * effect;
    }
    fit.standardError =
      fit.residual * std::sqrt(sumOf(squares) / squaredLength(fit.gradient));
    if (std::isfinite(fit.standardError))
    {
      return fit;
    }
  }
  return std::nullopt;
}

template std::optional<PolynomialFit> fitPolynomial<2>(
  const FrameSamples&, const FrameWeights&, const Vector&);
template std::optional<PolynomialFit> fitPolynomial<3>(
  const FrameSamples&, const FrameWeights&, const Vector&);

} // namespace isopoint
