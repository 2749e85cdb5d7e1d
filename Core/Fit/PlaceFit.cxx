// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/PlaceFit.h"

#include "Core/Fit/NormalEquations.h"
#include "Core/Fit/PolynomialFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isopoint
{
namespace
{

constexpr double steepOffset = 0.1;
constexpr std::size_t candidateCount = 4; // of the blend: affine, two quadratics, cubic

/// The largest power of two up to a number, or 1 if its reciprocal is not exact.
double unitOf(double size)
{
  const double unit = size > 0.0 ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
  return std::isnormal(unit) && std::isnormal(1.0 / unit) ? unit : 1.0;
}

/// A factor for values whose differences may overflow: a power of two, mostly 1.
double shrinkFor(const std::vector<SampleNumbers>& values, std::size_t count)
{
  constexpr double large = 1e300;
  double largest = 0.0;
  for (const SampleNumbers& numbers : values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      largest = std::max(largest, std::abs(numbers[i]));
    }
  }
  return largest > large ? std::ldexp(1.0, -20) : 1.0;
}

/// The weight of an estimate among others: the inverse square of its variance, relative to the
/// least one.
double shareOf(double variance, double least)
{
  const double ratio = variance > least ? least / variance : 1.0;
  return ratio * ratio;
}

} // namespace

void PlaceFitter::prepare(const std::vector<Vector>& offsets, std::size_t count, double reach)
{
  constexpr double equal = 1.0 - 1e-9;
  constexpr double beyond = 1.21;
  this->PerUnit = 1.0 / unitOf(reach);
  this->SquaredReach = (this->PerUnit * reach) * (this->PerUnit * reach);
  this->Count = count;
  this->Samples.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Samples.add(this->PerUnit * offsets[i], 0.0);
  }
  if (this->Samples.squaredDistance[0] >= equal * this->SquaredReach)
  {
    this->SquaredReach *= beyond; // the samples around have the same distance
  }
  switch (this->Method)
  {
    case PlaceMethod::Blend:
      this->prepareBlend();
      break;
    case PlaceMethod::Nearest:
      for (SampleNumbers& weights : this->Stencil)
      {
        weights[0] = 0.0;
      }
      this->Stencil[0][0] = 1.0;
      break;
    default:
      this->weigh(this->SquaredReach, this->Method != PlaceMethod::Affine);
      if (this->Method == PlaceMethod::Cubic && areEnough(this->Count, 3))
      {
        this->makeStencil(this->Cubic);
      }
      else if (this->Method != PlaceMethod::Affine && areEnough(this->Count, 2))
      {
        this->makeStencil(this->Steep);
      }
      else
      {
        this->makeStencil(this->Affine);
      }
  }
}

void PlaceFitter::prepareFrom(const double* weights, std::size_t count)
{
  this->Count = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t k = 0; k < laneCount; ++k)
    {
      this->Stencil[k][i] = weights[laneCount * i + k];
    }
  }
}

/// Weights that vanish at a distance from the place.
void PlaceFitter::weigh(double squaredReach, bool isSteep)
{
  const double mean = this->Samples.meanDistance();
  const double scale = mean > 0.0 ? 1.0 / (mean * mean) : 0.0;
  const double perReach = squaredReach > 0.0 ? 1.0 / squaredReach : 0.0;
  const std::size_t groups = this->Samples.groupCount();
  for (std::size_t g = 0; g < groups; ++g)
  {
    const Lanes squared = this->Samples.squaredDistance.group(g);
    const Lanes taper = (1.0 - perReach * squared).max(0.0);
    const Lanes base = steepOffset + scale * squared;
    this->Weights.setGroup(
      g, isSteep ? Lanes(taper * taper / (base * base * base)) : Lanes(taper * taper));
  }
  endWeights(this->Samples, this->Weights);
}

template <class Fit>
void PlaceFitter::makeStencil(Fit& fit)
{
  fit.findEffects(this->Samples, this->Weights, this->Stencil);
  for (std::size_t k = 1; k < laneCount; ++k)
  {
    for (std::size_t g = 0; g < this->Samples.groupCount(); ++g)
    {
      this->Stencil[k].setGroup(g, this->PerUnit * this->Stencil[k].group(g));
    }
  }
}

void PlaceFitter::prepareBlend()
{
  constexpr std::size_t fewAffine = 24;
  constexpr std::size_t fewSteep = 40;
  const FrameSamples& samples = this->Samples;
  const auto reachOf = [&](std::size_t count)
  { return count < this->Count ? samples.squaredDistance[count] : this->SquaredReach; };
  this->weigh(reachOf(fewAffine), false);
  this->Affine.prepare(samples, this->Weights, this->HasGradients);
  this->HasQuadratic = areEnough(std::min(this->Count, fewSteep), 2);
  if (this->HasQuadratic)
  {
    this->weigh(this->SquaredReach, false);
    this->Mild.prepare(samples, this->Weights, this->HasGradients);
    this->weigh(reachOf(fewSteep), true);
    this->Steep.prepare(samples, this->Weights, this->HasGradients);
  }
  this->HasCubic = areEnough(this->Count, 3);
  if (this->HasCubic)
  {
    this->weigh(this->SquaredReach, true);
    this->Cubic.prepare(samples, this->Weights, this->HasGradients);
  }
  constexpr double inner = 4.0; // samples up to sqrt(3) / 2 of the reach count fully
  const double perReach = this->SquaredReach > 0.0 ? 1.0 / this->SquaredReach : 0.0;
  for (std::size_t g = 0; g < samples.groupCount(); ++g)
  {
    this->Limits.setGroup(
      g, (inner * (1.0 - perReach * samples.squaredDistance.group(g))).max(0.0).min(1.0));
  }
}

void PlaceFitter::apply(
  std::vector<SampleNumbers>& values, double valueError, double* value, double* gradient)
{
  const double shrink = shrinkFor(values, this->Count);
  double largest = 0.0;
  double least = shrink * values[0][0]; // of one component
  double greatest = least;
  this->Bases.clear();
  this->Extends = false;
  for (SampleNumbers& numbers : values)
  {
    const double base = shrink * numbers[0];
    this->Bases.push_back(base);
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      numbers[i] *= shrink;
      least = std::min(least, numbers[i]);
      greatest = std::max(greatest, numbers[i]);
      numbers[i] -= base;
      largest = std::max(largest, std::abs(numbers[i]));
    }
  }
  this->Fitted.assign(values.size(), Lanes::Zero());
  double unit = 1.0;
  if (largest > 0.0)
  {
    if (this->Method == PlaceMethod::Blend)
    {
      unit = unitOf(largest);
      for (SampleNumbers& numbers : values)
      {
        endWeights(this->Samples, numbers);
        for (std::size_t g = 0; g < this->Samples.groupCount(); ++g)
        {
          numbers.setGroup(g, 1.0 / unit * numbers.group(g));
        }
      }
      this->blend(values, shrink * valueError / unit);
    }
    else
    {
      this->applyStencil(values);
    }
  }
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    const Lanes& fitted = this->Fitted[c];
    value[c] = this->Bases[c] + unit * fitted[0];
    if (this->Method == PlaceMethod::Blend && values.size() == 1 && !this->Extends)
    {
      value[c] = std::clamp(value[c], least, greatest); // may exceed them by rounding
    }
    value[c] /= shrink;
    if (gradient)
    {
      const double factor =
        (this->Method == PlaceMethod::Blend ? unit * this->PerUnit : unit) / shrink;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        gradient[3 * c + axis] = factor * fitted[static_cast<Eigen::Index>(axis) + 1];
      }
    }
  }
}

void PlaceFitter::applyStencil(const std::vector<SampleNumbers>& values)
{
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    for (std::size_t k = 0; k < laneCount; ++k)
    {
      double sum = 0.0;
      for (std::size_t i = 0; i < this->Count; ++i)
      {
        sum += this->Stencil[k][i] * values[c][i];
      }
      this->Fitted[c][static_cast<Eigen::Index>(k)] = sum;
    }
  }
}

void PlaceFitter::blend(const std::vector<SampleNumbers>& values, double valueError)
{
  struct Estimate
  {
    double valueVariance = std::numeric_limits<double>::infinity();
    double gradientVariance = std::numeric_limits<double>::infinity();
  };
  const std::size_t components = values.size();
  std::array<Estimate, candidateCount> estimates;
  this->Candidates.assign(candidateCount * components, Lanes::Zero());
  const double variance = static_cast<double>(components) * valueError * valueError;
  this->Means.resize(components);
  const auto estimate = [&](std::size_t candidate, const auto& fit)
  {
    double squares = 0.0;
    for (std::size_t c = 0; c < components; ++c)
    {
      const auto result = fit.fit(values[c]);
      squares += result.squares;
      this->Candidates[candidate * components + c] = result.atPlace;
      this->Means[c] = result.mean;
    }
    estimates[candidate] = { fit.valueVariance(squares, variance),
      fit.gradientVariance(squares, variance) };
  };
  estimate(0, this->Affine);
  if (this->HasQuadratic)
  {
    estimate(1, this->Mild);
    estimate(2, this->Steep);
  }
  if (this->HasCubic)
  {
    estimate(3, this->Cubic);
  }
  Estimate least;
  for (const Estimate& one : estimates)
  {
    least.valueVariance = std::min(least.valueVariance, one.valueVariance);
    least.gradientVariance = std::min(least.gradientVariance, one.gradientVariance);
  }
  Lanes total = Lanes::Zero();
  for (std::size_t i = 0; i < candidateCount; ++i)
  {
    Lanes share = Lanes::Constant(shareOf(estimates[i].gradientVariance, least.gradientVariance));
    share[0] = shareOf(estimates[i].valueVariance, least.valueVariance);
    if (!std::isfinite(estimates[i].valueVariance))
    {
      continue;
    }
    total += share;
    for (std::size_t c = 0; c < components; ++c)
    {
      this->Fitted[c] += share * this->Candidates[i * components + c];
    }
  }
  for (Lanes& fitted : this->Fitted)
  {
    fitted /= total;
  }
  this->limit(values);
}

/// Whether the samples show extrema between them: from 0 to 1.
/// @param spread the largest squared difference from the mean, in its limits
double PlaceFitter::resolution(const std::vector<SampleNumbers>& values, double spread) const
{
  constexpr double resolved = 0.05;
  constexpr double unresolved = 0.1;
  if (!this->HasCubic)
  {
    return 0.0;
  }
  SampleNumbers residuals;
  for (std::size_t i = 0; i < laneCount * this->Samples.groupCount(); ++i)
  {
    residuals[i] = 0.0;
  }
  for (const SampleNumbers& numbers : values)
  {
    this->Cubic.addSquaredResiduals(numbers, residuals);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    worst = std::max(worst, this->Limits[i] * this->Limits[i] * residuals[i]);
  }
  return std::clamp((unresolved - std::sqrt(worst / spread)) / (unresolved - resolved), 0.0, 1.0);
}

/// Keeps the value in the range of the samples or, if it has several components, in the ball around
/// their mean, so that turned data give turned results. Samples near the reach count less.
void PlaceFitter::limit(const std::vector<SampleNumbers>& values)
{
  const std::size_t components = values.size();
  const auto squaredDifference = [&](const auto& numberOf)
  {
    double squared = 0.0;
    for (std::size_t c = 0; c < components; ++c)
    {
      const double difference = numberOf(c) - this->Means[c];
      squared += difference * difference;
    }
    return squared;
  };
  double spread = 0.0;
  double least = 0.0; // of one component, from the mean
  double greatest = 0.0;
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    const double limit = this->Limits[i];
    spread = std::max(
      spread, limit * limit * squaredDifference([&](std::size_t c) { return values[c][i]; }));
    const double difference = limit * (values[0][i] - this->Means[0]);
    least = std::min(least, difference);
    greatest = std::max(greatest, difference);
  }
  const double squared = squaredDifference([&](std::size_t c) { return this->Fitted[c][0]; });
  const double difference = this->Fitted[0][0] - this->Means[0];
  const double length = components == 1 ? std::abs(difference) : std::sqrt(squared);
  const double most = components == 1 ? (difference > 0.0 ? greatest : -least) : std::sqrt(spread);
  if (length > most)
  {
    double ofCubic = 0.0; // how far the cubic goes in the same direction
    for (std::size_t c = 0; c < components && this->HasCubic; ++c)
    {
      ofCubic += (this->Candidates[(candidateCount - 1) * components + c][0] - this->Means[c]) *
                 (this->Fitted[c][0] - this->Means[c]) / length;
    }
    const double resolution = this->resolution(values, spread);
    const double limited = std::min(length, most + resolution * std::max(0.0, ofCubic - most));
    this->Extends = resolution > 0.0;
    for (std::size_t c = 0; c < components; ++c)
    {
      this->Fitted[c][0] =
        this->Means[c] + limited / length * (this->Fitted[c][0] - this->Means[c]);
    }
  }
}

} // namespace isopoint
