// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FitTesting_h
#define FitTesting_h

#include "Clouds.h"

#include "Core/Fit/LocalFit.h"
#include "Core/Fit/LocalFitter.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// Shared by the tests of fits.
namespace fittesting
{

using isopoint::cross;
using isopoint::difference;
using isopoint::dot;
using isopoint::FitEdge;
using isopoint::FitOrder;
using isopoint::FitRequest;
using isopoint::FitSample;
using isopoint::lengthOf;
using isopoint::LocalFit;
using isopoint::scaled;
using isopoint::Vector;

using Field = std::function<double(const Vector&)>;

inline double degreesBetween(const Vector& a, const Vector& b)
{
  return std::atan2(lengthOf(cross(a, b)), dot(a, b)) * 180.0 / 3.14159265358979;
}

inline std::vector<FitSample> samplesOf(
  const Field& field, std::size_t count, double noise = 0.0, std::uint64_t seed = 11)
{
  clouds::Random random(seed);
  std::vector<FitSample> samples;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p{ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 4.0 * random() - 2.0 };
    samples.push_back({ p, field(p) + noise * (random() - 0.5) });
  }
  return samples;
}

/// Fits to the samples around an edge, as is done for each isopoint.
/// @param nearCount how many of them, the first ones, are next to its ends; 0: all
inline LocalFit fitAll(const std::vector<FitSample>& samples, const FitEdge& edge, FitOrder highest,
  double isovalue = 0.0, std::size_t nearCount = 0)
{
  const std::size_t count = nearCount > 0 ? nearCount : samples.size();
  isopoint::LocalFitter fitter(isovalue, highest);
  const auto end = samples.begin() + static_cast<std::ptrdiff_t>(count);
  const std::optional<LocalFit> near = fitter.fitNear(edge, { samples.begin(), end });
  return near ? *near : fitter.fit(edge, samples, count);
}

/// What the samples next to an edge decide alone.
inline std::optional<LocalFit> fitNear(const std::vector<FitSample>& samples, const FitEdge& edge,
  FitOrder highest = FitOrder::Cubic, double isovalue = 0.0)
{
  return isopoint::LocalFitter(isovalue, highest).fitNear(edge, samples);
}

/// A vertical edge of length 2, on which linear interpolation places the isopoint at the origin.
inline FitEdge upwards(double increase = 2.0)
{
  return { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 }, increase, 1.0 };
}

inline isopoint::Isosurface extractFitted(const clouds::Cloud& cloud, double isovalue, bool move,
  std::size_t threads = 2, std::optional<FitOrder> highest = FitOrder::Cubic,
  double valueError = 0.0)
{
  const isopoint::Execution execution = clouds::executionOn(threads);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>(execution, cloud.size(), clouds::readerOf(cloud));
  extractor.setValueError(valueError);
  return clouds::extractFrom(
    extractor, execution, isovalue, 54.7, 0.0, FitRequest{ highest, move });
}

inline clouds::Cloud cloudOf(const Field& field, std::size_t count, double side)
{
  clouds::Random random(2);
  clouds::Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p{ side * (random() - 0.5), side * (random() - 0.5), side * (random() - 0.5) };
    cloud.add(p[0], p[1], p[2], field(p));
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

/// The gradient of a field, by forward differences.
inline Vector gradientOf(const Field& field, const Vector& p)
{
  constexpr double step = 1e-5;
  const double value = field(p);
  return scaled(1.0 / step,
    Vector{ field({ p[0] + step, p[1], p[2] }) - value, field({ p[0], p[1] + step, p[2] }) - value,
      field({ p[0], p[1], p[2] + step }) - value });
}

} // namespace fittesting

#endif
