// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

namespace isopoint
{

namespace
{

/// Multiplies the lengths that the output has by 2^exponent.
void multiplyLengths(const Execution& execution, ExtractedIsosurface& result, int exponent)
{
  if (exponent == 0)
  {
    return;
  }
  const auto change = [&execution](auto& elements, const auto& changeOne)
  { forEachIndex(execution, elements.size(), [&](std::size_t i) { changeOne(elements[i]); }); };
  const auto multiply = [exponent](Vector& vector)
  {
    using Limits = std::numeric_limits<double>; // a fit may move points beyond the greatest sample
    for (double& coordinate : vector)
    {
      coordinate = std::clamp(std::ldexp(coordinate, exponent), Limits::lowest(), Limits::max());
    }
  };
  change(result.surface.positions, multiply);
  change(result.surface.decreasingEdges, multiply);
  change(result.surface.fits,
    [&](LocalFit& fit)
    {
      multiply(fit.position);
      for (double& derivative : fit.gradient)
      {
        derivative = std::ldexp(derivative, -exponent);
      }
    });
  change(result.splats,
    [&](Splat& splat)
    {
      multiply(splat.axis);
      splat.radius = std::ldexp(splat.radius, exponent);
    });
}

/// The spacing of samples spread evenly in a box; 0 if it is one position, or without samples.
double spacingIn(const Region& box, std::size_t count)
{
  if (count == 0)
  {
    return 0.0;
  }
  Vector sides = box.upper - box.lower;
  std::sort(sides.begin(), sides.end(), std::greater<>());
  const double share = 1.0 / static_cast<double>(count);
  return std::max({ sides[0] * share, std::sqrt(sides[0] * sides[1] * share),
    std::cbrt(sides[0] * sides[1] * sides[2] * share) });
}

} // namespace

void IsosurfaceExtractor::clear()
{
  this->Cloud = SampleCloud<FloatSample>();
  this->Processes = nullptr;
  this->ItemCount = 0;
  this->ItemCounts.clear();
}

std::size_t IsosurfaceExtractor::sampleCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.ownCount(); }, this->Cloud);
}

std::size_t IsosurfaceExtractor::skippedCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.skipped; }, this->Cloud);
}

double IsosurfaceExtractor::spacingInFloatSteps() const
{
  return std::visit(
    [](const auto& cloud)
    {
      using Sample = std::decay_t<decltype(cloud.tree.samples[0])>;
      const Region& box = cloud.tree.region;
      const double spacing = spacingIn(box, cloud.tree.samples.size());
      if (!std::is_same_v<typename Sample::Coordinate, float> || spacing == 0.0)
      {
        return unbounded;
      }
      double step = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto farthest =
          static_cast<float>(std::max(std::abs(box.lower[axis]), std::abs(box.upper[axis])));
        step = std::max<double>(
          step, std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest);
      }
      return spacing / step;
    },
    this->Cloud);
}

std::pair<double, double> IsosurfaceExtractor::valueRange() const
{
  return std::visit(
    [](const auto& cloud)
    {
      using Range = std::pair<double, double>;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      if (cloud.tree.isEmpty())
      {
        return Range(infinity, -infinity);
      }
      const auto& root = cloud.tree.nodes[rootNode];
      return Range(root.minimum, root.maximum);
    },
    this->Cloud);
}

void IsosurfaceExtractor::setValueError(double error)
{
  std::visit([error](auto& cloud) { cloud.tree.valueError = error; }, this->Cloud);
}

ExtractedIsosurface IsosurfaceExtractor::extract(
  const Execution& execution, const ExtractionRequest& request, ExtractedIsosurface* ghosts)
{
  const Execution rising = withRisingProgress(execution);
  ExtractedIsosurface result = std::visit(
    [&](auto& cloud)
    {
      ExtractedIsosurface found =
        extractFromCloud(rising, cloud, this->ItemCount, this->Processes, request, ghosts);
      multiplyLengths(execution, found, cloud.exponent);
      if (ghosts)
      {
        multiplyLengths(execution, *ghosts, cloud.exponent);
      }
      return found;
    },
    this->Cloud);
  execution.progress(1.0);
  return result;
}

} // namespace isopoint
