// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/IsosurfaceExtractor.h"

#include "Core/Extraction/ExpectedWork.h"

#include <limits>

namespace isopoint
{

void IsosurfaceExtractor::clear()
{
  this->Held = SampleCloud<FloatSample>();
  this->Group = nullptr;
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

double IsosurfaceExtractor::loadingWork(std::size_t count)
{
  return work::loading * static_cast<double>(count);
}

double IsosurfaceExtractor::extractionWork(
  std::size_t count, const ExtractionRequest& request, bool isTreeKept)
{
  if (count == 0)
  {
    return 0.0;
  }
  BandForecast forecast(count);
  forecast.observe(0, 1, isTreeKept ? 0.0 : 1.0);
  const double forIsopoint =
    (request.triangles ? work::tetrahedrizing : work::finding) + work::placing + work::writing +
    (request.isosurface.fit ? work::fitting : 0.0) + (request.splats ? work::splatting : 0.0);
  return forecast.bandWork(0) + forIsopoint * forecast.isopointCount();
}

ExtractedIsosurface IsosurfaceExtractor::extract(
  const Execution& execution, const ExtractionRequest& request, ExtractedIsosurface* ghosts)
{
  return std::visit([&](auto& cloud)
    { return extractFromCloud(execution, cloud, this->ItemCount, this->Group, request, ghosts); },
    this->Held);
}

} // namespace isopoint
