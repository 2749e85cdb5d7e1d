// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Fit/LocalFitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <cstdlib>

namespace isopoint
{
double tune(const char*name,double v){ const char*e=std::getenv(name); return e?std::atof(e):v; }
static const double K_most=tune("FIT_K",96), K_fine=tune("FIT_FINE",0.002), K_accept=tune("FIT_ACCEPT",0.1),K_shrink=tune("FIT_SHRINK",0.1),K_robust=tune("FIT_ROBUST",3),K_half=tune("FIT_HALF",0.5), K_soft=tune("FIT_SOFT",0.1);
static const int K_iter=tune("FIT_ITER",3);

namespace
{

/// The unit of lengths or values: a power of two, by which numbers are divided without rounding.
double unitOf(double size)
{
  return std::isfinite(size) && size > 0.0 ? std::ldexp(1.0, -std::ilogb(size)) : 0.0;
}

FrameWeights steepWeights(const FrameSamples& samples)
{
  Lanes distances = Lanes::Zero();
  for (std::size_t i = 0; i < samples.groupCount(); ++i)
  {
    distances += samples.squaredDistance[i].sqrt();
  }
  const double mean = sumOf(distances) / static_cast<double>(samples.count);
  const double scale = 1.0 / (mean * mean);
  FrameWeights weights;
  for (std::size_t i = 0; i < samples.groupCount(); ++i)
  {
    const Lanes softened = K_soft + scale * samples.squaredDistance[i];
    weights[i] = 1.0 / (softened * softened * softened);
  }
  for (std::size_t i = samples.count; i < laneCount * samples.groupCount(); ++i)
  {
    FrameSamples::at(weights, i) = 0.0;
  }
  return weights;
}
FrameWeights mildWeights(const FrameSamples& samples)
{
  Lanes distances = Lanes::Zero();
  for (std::size_t i = 0; i < samples.groupCount(); ++i)
  {
    distances += samples.squaredDistance[i].sqrt();
  }
  const double mean = sumOf(distances) / static_cast<double>(samples.count);
  const double scale = 1.0 / (mean * mean);
  FrameWeights weights;
  for (std::size_t i = 0; i < samples.groupCount(); ++i)
  {
    weights[i] = 1.0 / (1.0 + scale * samples.squaredDistance[i]);
  }
  for (std::size_t i = samples.count; i < laneCount * samples.groupCount(); ++i)
  {
    FrameSamples::at(weights, i) = 0.0;
  }
  return weights;
}

} // namespace

/// Moves the samples into the frame, the nearest ones of many. @returns whether all is finite
bool LocalFitter::enterFrame(const FitEdge& edge, const std::vector<FitSample>& samples)
{
  this->LengthUnit = unitOf(lengthOf(edge.increasing));
  this->ValueUnit = unitOf(edge.increase);
  if (!(this->LengthUnit > 0.0 && std::isfinite(this->LengthUnit) && this->ValueUnit > 0.0 &&
        std::isfinite(this->ValueUnit)))
  {
    return false;
  }
  this->Increasing = scaled(this->LengthUnit, edge.increasing);
  this->Distances.clear();
  for (const FitSample& sample : samples)
  {
    const Vector offset = scaled(this->LengthUnit, difference(sample.position, edge.position));
    this->Distances.push_back(dot(offset, offset));
  }
  double limit = std::numeric_limits<double>::infinity();
  std::size_t wanted = std::min<std::size_t>(samples.size(), K_most);
  if (wanted < samples.size())
  {
    std::vector<double> d = this->Distances;
    std::nth_element(d.begin(), d.begin() + wanted - 1, d.end());
    limit = d[wanted - 1];
  }
  FrameSamples& frame = this->Samples;
  frame.count = 0;
  const auto add = [&](std::size_t i)
  {
    const Vector offset = scaled(this->LengthUnit, difference(samples[i].position, edge.position));
    const std::size_t at = frame.count++;
    FrameSamples::at(frame.x, at) = offset[0];
    FrameSamples::at(frame.y, at) = offset[1];
    FrameSamples::at(frame.z, at) = offset[2];
    FrameSamples::at(frame.value, at) = this->ValueUnit * (samples[i].value - this->Isovalue);
    FrameSamples::at(frame.squaredDistance, at) = this->Distances[i];
  };
  std::size_t less=0;
  for (std::size_t i = 0; i < samples.size(); ++i) less += this->Distances[i] < limit;
  std::size_t equal = wanted - std::min(wanted,less);
  for (std::size_t i = 0; i < samples.size() && frame.count < wanted; ++i)
  {
    if (this->Distances[i] < limit) add(i);
    else if (this->Distances[i] == limit && equal > 0) { add(i); --equal; }
  }
  for (std::size_t at = frame.count; at < laneCount * frame.groupCount(); ++at)
  {
    FrameSamples::at(frame.x, at) = 0.0;
    FrameSamples::at(frame.y, at) = 0.0;
    FrameSamples::at(frame.z, at) = 0.0;
    FrameSamples::at(frame.value, at) = 0.0;
    FrameSamples::at(frame.squaredDistance, at) = 0.0;
  }
  return true;
}

void LocalFitter::apply(const FitEdge& edge, const PolynomialFit& found, double share, LocalFit& fit) const
{
  const double slope = this->LengthUnit / this->ValueUnit;
  fit.position = sum(edge.position, share / this->LengthUnit, found.zero);
  fit.gradient = scaled(slope, found.gradient);
  const Hessian hessian = found.polynomial.hessianAt(found.zero);
  for (std::size_t i = 0; i < hessian.size(); ++i)
  {
    fit.hessian[i] = slope * this->LengthUnit * hessian[i];
  }
  fit.isGradientFitted = true;
  fit.order = static_cast<FitOrder>(found.polynomial.degree);
}

bool LocalFitter::fitSmooth(const FitEdge& edge, const std::vector<FitSample>& samples, LocalFit& fit)
{
  if (!this->enterFrame(edge, samples))
  {
    return false;
  }
  const FrameWeights weights = steepWeights(this->Samples);
  const std::optional<PolynomialFit> quadratic =
    fitPolynomial<2>(this->Samples, weights, this->Increasing);
  if (!quadratic || !(quadratic->residual <= K_fine * lengthOf(quadratic->gradient)))
  {
    return false;
  }
  this->apply(edge, *quadratic, 1.0, fit);
  return true;
}

FrameWeights LocalFitter::robustWeights(const FrameWeights& steep) const
{
  const FrameSamples& samples = this->Samples;
  FrameWeights weights;
  for (std::size_t i = 0; i < samples.groupCount(); ++i)
  {
    weights[i] = steep[i];
  }
  for (int round = 0; round < K_iter; ++round)
  {
    const NormalEquations<1> equations(samples, weights);
    if (equations.determinedDegree() < 1)
    {
      return weights;
    }
    const Polynomial affine = equations.solution(1);
    FrameSamples::Numbers residuals;
    std::array<double, mostFitSamples> magnitudes;
    for (std::size_t i = 0; i < samples.groupCount(); ++i)
    {
      residuals[i] =
        (samples.value[i] - affine.valueAt(samples.x[i], samples.y[i], samples.z[i])).abs();
    }
    for (std::size_t i = 0; i < samples.count; ++i)
    {
      magnitudes[i] = FrameSamples::at(residuals, i);
    }
    const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(samples.count / 2);
    std::nth_element(
      magnitudes.begin(), middle, magnitudes.begin() + static_cast<std::ptrdiff_t>(samples.count));
    const double scale = 1.0 / (K_robust * *middle);
    for (std::size_t i = 0; i < samples.groupCount(); ++i)
    {
      const Lanes ratio = scale * residuals[i];
      const Lanes factor = 1.0 + ratio * ratio;
      weights[i] = steep[i] / (factor * factor);
    }
  }
  return weights;
}

LocalFit LocalFitter::fit(const FitEdge& edge, const std::vector<FitSample>& samples)
{
  LocalFit fit{};
  fit.position = edge.position;
  fit.spacing = edge.spacing;
  const double length = lengthOf(edge.increasing);
  fit.gradient = scaled(edge.increase / length / length, edge.increasing);
  if (!this->enterFrame(edge, samples))
  {
    return fit;
  }
  const FrameWeights weights = steepWeights(this->Samples);
  const auto fitWith = [&](const FrameWeights& w)
  {
    return this->Request.highest == FitOrder::Quadratic
             ? fitPolynomial<2>(this->Samples, w, this->Increasing)
             : fitPolynomial<3>(this->Samples, w, this->Increasing);
  };
  std::optional<PolynomialFit> best = fitWith(weights);
  if (!best || !(best->standardError < K_accept * best->move))
  {
    const std::optional<PolynomialFit> robust = fitWith(this->robustWeights(weights));
    if (robust && (!best || robust->standardError < K_half * best->standardError))
    {
      best = robust;
    }
  }
  if (best)
  {
    const double m2 = best->move * best->move;
    const double s2 = best->standardError * best->standardError;
    this->apply(edge, *best, m2 > 0.0 ? m2 / (m2 + K_shrink * s2) : 1.0, fit);
    return fit;
  }
  const NormalEquations<1> affine(this->Samples, mildWeights(this->Samples));
  if (affine.determinedDegree() == 1)
  {
    const Vector gradient = affine.solution(1).gradientAt({});
    if (increasesAlong(this->Increasing, gradient))
    {
      fit.gradient = scaled(this->LengthUnit / this->ValueUnit, gradient);
      fit.isGradientFitted = true;
    }
  }
  return fit;
}

} // namespace isopoint
