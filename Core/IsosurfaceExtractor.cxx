// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/IsosurfaceExtractor.h"

#include <limits>

namespace isopoint
{

void IsosurfaceExtractor::clear()
{
  this->Held = SampleCloud<FloatSample>();
  this->Processes = nullptr;
  this->ItemCount = 0;
  this->ItemCounts.clear();
}

std::size_t IsosurfaceExtractor::sampleCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.ownCount(); }, this->Held);
}

std::size_t IsosurfaceExtractor::skippedCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.skipped; }, this->Held);
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
      const auto& root = cloud.tree.nodes[cloud.tree.rootNode];
      return Range(root.minimum, root.maximum);
    },
    this->Held);
}

void IsosurfaceExtractor::setValueError(double error)
{
  std::visit([error](auto& cloud) { cloud.tree.valueError = error; }, this->Held);
}

ExtractedIsosurface IsosurfaceExtractor::extract(
  const Execution& execution, const ExtractionRequest& request, ExtractedIsosurface* ghosts)
{
  const Execution rising = withRisingProgress(execution);
  ExtractedIsosurface result = std::visit([&](auto& cloud)
    { return extractFromCloud(rising, cloud, this->ItemCount, this->Processes, request, ghosts); },
    this->Held);
  execution.progress(1.0);
  return result;
}

} // namespace isopoint
