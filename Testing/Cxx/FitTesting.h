// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Clouds.h"

#include "Core/Fit/FrameSamples.h"
#include "Core/Fit/LocalFitter.h"

#include <gtest/gtest.h>

/// Shared by the tests of fits.
namespace fittesting
{

using namespace isopoint;
using Field = std::function<double(const Vector&)>;

constexpr FitOrder allOrders[] = { FitOrder::Linear, FitOrder::Quadratic, FitOrder::Cubic,
  FitOrder::Crease };

/// Random samples in a cube of side 4.
inline std::vector<FitSample> samplesOf(
  const Field& field, std::size_t count, double noise = 0.0, std::uint64_t seed = 11)
{
  clouds::Random random(seed);
  std::vector<FitSample> samples(count);
  for (FitSample& sample : samples)
  {
    sample.position = random.inCube(4.0);
    sample.value = field(sample.position) + noise * (random() - 0.5);
  }
  return samples;
}

/// Samples and weights, as the parts of fits take them.
struct FrameCase
{
  FrameSamples samples;
  FrameWeights weights;

  explicit FrameCase(const std::vector<FitSample>& all = {})
  {
    for (const FitSample& sample : all)
    {
      this->add(sample.position, sample.value);
    }
  }

  void add(const Vector& place, double value, double weight = 1.0)
  {
    this->samples.add(place, value);
    this->weights[this->samples.count() - 1] = weight;
    endWeights(this->samples, this->weights);
  }
};

/// Fits to the samples around an edge, as is done for each isopoint.
/// @param nearCount how many of them, the first ones, are next to its ends; 0: all
inline LocalFit fitAll(const std::vector<FitSample>& samples, const FitEdge& edge, FitOrder highest,
  double isovalue = 0.0, std::size_t nearCount = 0)
{
  const std::size_t count = nearCount > 0 ? nearCount : samples.size();
  LocalFitter fitter(isovalue, highest);
  const auto end = samples.begin() + static_cast<std::ptrdiff_t>(count);
  const std::optional<LocalFit> near = fitter.fitNear(edge, { samples.begin(), end });
  return near ? *near : fitter.fit(edge, samples, count);
}

/// A vertical edge of length 2, on which linear interpolation places the isopoint at the origin.
inline FitEdge upwards()
{
  return { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 }, 2.0, 1.0 };
}

inline Isosurface extractFitted(const clouds::Cloud& cloud, double isovalue, bool move,
  std::size_t threads = 2, std::optional<FitOrder> highest = FitOrder::Cubic,
  double valueError = 0.0)
{
  IsosurfaceExtractor extractor = clouds::loaded(cloud, threads);
  extractor.setValueError(valueError);
  ExtractionRequest request = clouds::requestOf(isovalue);
  request.isosurface.fit = FitRequest{ highest, move };
  return extractor.extract(clouds::executionOn(threads), request).surface;
}

inline clouds::Cloud cloudOf(const Field& field, std::size_t count, double side)
{
  clouds::Random random(2);
  clouds::Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p = random.inCube(side);
    cloud.add(p, field(p));
  }
  return cloud;
}

inline Field gyroid(double waveNumber)
{
  return [k = waveNumber](const Vector& p)
  {
    return std::sin(k * p[0]) * std::cos(k * p[1]) + std::sin(k * p[1]) * std::cos(k * p[2]) +
           std::sin(k * p[2]) * std::cos(k * p[0]);
  };
}

} // namespace fittesting
