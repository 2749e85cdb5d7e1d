// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/IsosurfaceExtractor.h"

#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Neighbors/SampleExtent.h"

namespace isopoint
{

void IsosurfaceExtractor::clear()
{
  this->Tree = SampleTree<FloatSample>();
  this->ItemCount = 0;
}

std::size_t IsosurfaceExtractor::sampleCount() const
{
  return std::visit([](const auto& tree) { return tree.samples.size(); }, this->Tree);
}

std::size_t IsosurfaceExtractor::skippedCount() const
{
  return std::visit([](const auto& tree) { return tree.skipped; }, this->Tree);
}

Isosurface IsosurfaceExtractor::extract(const Execution& execution, double isovalue, double angle,
  double gapFactor, std::optional<FitRequest> fitRequest)
{
  return std::visit(
    [&](auto& tree)
    {
      return extractIsosurface(
        execution, tree, isovalue, angle, gapFactor, this->ItemCount, fitRequest);
    },
    this->Tree);
}

SampleExtents IsosurfaceExtractor::sampleExtents() const
{
  return std::visit([](const auto& tree) { return extentsOf(tree); }, this->Tree);
}

} // namespace isopoint
