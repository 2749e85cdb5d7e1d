// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/IsosurfaceExtractor.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

bool IsosurfaceExtractor::hasFloatPositions() const
{
  return std::visit(
    [](const auto& cloud)
    {
      using Sample = std::decay_t<decltype(cloud.tree.samples[0])>;
      return std::is_same_v<typename Sample::Coordinate, float>;
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
