// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Fit/PlaceFit.h"

#include "Core/Fit/NormalEquations.h"
#include "Core/Fit/PolynomialFit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isopoint
{
namespace
{

constexpr double steepOffset = 0.1;

/// The largest power of two up to a number, or 1 if its reciprocal is not exact.
double unitOf(double size)
{
  const double unit = size > 0.0 ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
  return std::isnormal(unit) && std::isnormal(1.0 / unit) ? unit : 1.0;
}

/// The weight of an estimate among others by its variance: the inverse fourth power of its error,
/// relative to the least one.
double shareOf(double variance, double least)
{
  const double ratio = variance > least ? least / variance : 1.0;
  return ratio * ratio;
}

} // namespace

void PlaceFitter::enter(const std::vector<Vector>& offsets, std::size_t count, double reach)
{
  constexpr double equal = 1.0 - 1e-9;
  constexpr double beyond = 1.21;
  this->PerUnit = 1.0 / unitOf(reach);
  this->SquaredReach = (this->PerUnit * reach) * (this->PerUnit * reach);
  this->Count = count;
  this->AllCount = offsets.size();
  this->IsTurned = false;
  this->Dimensions = 3;
  this->add(offsets);
  if (this->Samples.squaredDistance[0] >= equal * this->SquaredReach)
  {
    this->SquaredReach *= beyond; // the samples around have the same distance
  }
  if (this->Method != PlaceMethod::Nearest || this->AllCount > 1)
  {
    this->turn(offsets);
  }
}

void PlaceFitter::prepare()
{
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
  this->Count = this->AllCount = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t k = 0; k < laneCount; ++k)
    {
      this->Stencil[k][i] = weights[laneCount * i + k];
    }
  }
}

/// Lists the samples along the axes, and replaces coordinates across flat ones by their mean.
void PlaceFitter::add(const std::vector<Vector>& offsets)
{
  this->Samples.clear();
  for (const Vector& offset : offsets)
  {
    Vector own = this->PerUnit * offset;
    const double squared = dot(own, own);
    if (this->IsTurned)
    {
      own = { dot(own, this->Axes[0]), dot(own, this->Axes[1]), dot(own, this->Axes[2]) };
      for (auto axis = static_cast<std::size_t>(this->Dimensions); axis < 3; ++axis)
      {
        own[axis] = this->Mean[axis];
      }
    }
    this->Samples.add(own, 0.0, squared);
  }
}

/// Turns samples that are nearly in a plane or on a line to their principal axes: so what they
/// determine fades out as they become flat.
void PlaceFitter::turn(const std::vector<Vector>& offsets)
{
  // Methods that fit to few samples know more, which tell whether the place is outside.
  constexpr double beyond = 1.21;
  constexpr double thin = 0.02; // share of eigenvalues
  this->weigh(this->Count == this->AllCount
                ? this->SquaredReach
                : beyond * this->Samples.squaredDistance[this->AllCount - 1],
    false);
  const CholeskyFactor<1> factor(this->Samples, this->Weights);
  // The product of the pivots is that of the covariance's eigenvalues. Their sum is at most that of
  // the diagonal elements.
  const double sum = factor.diagonal(1) + factor.diagonal(2) + factor.diagonal(3);
  if (factor.pivot(1) * factor.pivot(2) * factor.pivot(3) > 4.0 / 27.0 * thin * sum * sum * sum)
  {
    return;
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double total = 0.0;
  const auto at = [this](std::size_t i)
  { return Eigen::Vector3d(this->Samples.x[i], this->Samples.y[i], this->Samples.z[i]); };
  for (std::size_t i = 0; i < this->AllCount; ++i)
  {
    mean += this->Weights[i] * at(i);
    total += this->Weights[i];
  }
  mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < this->AllCount; ++i)
  {
    const Eigen::Vector3d offset = at(i) - mean;
    covariance += this->Weights[i] * offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d& values = solver.eigenvalues(); // ascending
  if (values[0] > thin * values[2])
  {
    return;
  }
  this->IsTurned = true;
  this->Dimensions = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Eigen::Index column = 2 - static_cast<Eigen::Index>(axis);
    const Eigen::Vector3d direction = solver.eigenvectors().col(column);
    this->Axes[axis] = { direction[0], direction[1], direction[2] };
    this->Mean[axis] = mean.dot(direction);
    this->Dimensions += values[column] > minPivot * values[2] ? 1 : 0;
  }
  this->add(offsets);
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
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    const Vector gradient =
      this->inSpace({ this->Stencil[1][i], this->Stencil[2][i], this->Stencil[3][i] });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Stencil[axis + 1][i] = gradient[axis];
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

bool PlaceFitter::isOutside() const
{
  constexpr double farthest = 0.9; // spacings
  const std::size_t count = std::min(this->AllCount, countForOutside);
  const FrameSamples& samples = this->Samples;
  const double squared = samples.squaredDistance[0];
  if (!(squared > 0.0))
  {
    return false;
  }
  std::array<double, countForOutside> apart{}; // squared distances from the nearest sample
  std::array<Vector, countForOutside> directions{};
  Vector point{};
  bool isAtSample = false;
  for (std::size_t i = 0; i < count; ++i)
  {
    Vector offset{ samples.x[i], samples.y[i], samples.z[i] };
    const Vector fromNearest = offset - Vector{ samples.x[0], samples.y[0], samples.z[0] };
    apart[i] = dot(fromNearest, fromNearest);
    std::fill(offset.begin() + this->Dimensions, offset.end(), 0.0); // along flat samples
    isAtSample = isAtSample || !(dot(offset, offset) > 0.0);
    directions[i] = directionOf(offset);
    point += directions[i];
  }
  const auto eighth =
    apart.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(8, count - 1));
  std::nth_element(apart.begin(), eighth, apart.begin() + static_cast<std::ptrdiff_t>(count));
  if (squared > farthest * farthest * *eighth)
  {
    return true;
  }
  if (isAtSample)
  {
    return false;
  }
  // The point of least length in the convex hull of the directions (Frank and Wolfe), until a plane
  // through the place has all on one side.
  constexpr int steps = 12;
  constexpr double closest = 1e-6;
  point = 1.0 / static_cast<double>(count) * point;
  for (int step = 0; step < steps; ++step)
  {
    std::size_t least = 0;
    double product = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i)
    {
      const double p = dot(point, directions[i]);
      least = p < product ? i : least;
      product = std::min(product, p);
    }
    if (dot(point, point) <= closest * closest)
    {
      return false;
    }
    if (product > 0.0)
    {
      return true;
    }
    const Vector towards = directions[least] - point;
    const double share = -dot(point, towards) / dot(towards, towards);
    point += std::min(1.0, std::max(0.0, share)) * towards;
  }
  return false;
}

void PlaceFitter::apply(
  std::vector<SampleNumbers>& values, double valueError, double* value, double* gradient)
{
  double largest = 0.0;
  double least = values[0][0]; // of one component
  double greatest = least;
  this->Bases.clear();
  this->Extends = false;
  for (SampleNumbers& numbers : values)
  {
    const double base = numbers[0];
    this->Bases.push_back(base);
    for (std::size_t i = 0; i < this->Count; ++i)
    {
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
      this->blend(values, valueError / unit);
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
    if (gradient)
    {
      const Vector slope{ fitted[1], fitted[2], fitted[3] };
      const Vector own = unit * (this->Method == PlaceMethod::Blend ? this->inSpace(slope) : slope);
      std::copy(own.begin(), own.end(), gradient + 3 * c);
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
  constexpr std::size_t candidates = 4;
  const std::size_t components = values.size();
  std::array<Estimate, candidates> estimates;
  this->Candidates.assign(candidates * components, Lanes::Zero());
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
  for (std::size_t i = 0; i < candidates; ++i)
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
    const double resolution = this->resolution(values, spread);
    const double limited = most + resolution * (length - most);
    this->Extends = resolution > 0.0;
    for (std::size_t c = 0; c < components; ++c)
    {
      this->Fitted[c][0] =
        this->Means[c] + limited / length * (this->Fitted[c][0] - this->Means[c]);
    }
  }
}

/// A gradient in the frame of the samples, in space.
Vector PlaceFitter::inSpace(const Vector& gradient) const
{
  return this->PerUnit * (this->IsTurned
                             ? gradient[0] * this->Axes[0] + gradient[1] * this->Axes[1] +
                                 gradient[2] * this->Axes[2]
                             : gradient);
}

} // namespace isopoint
