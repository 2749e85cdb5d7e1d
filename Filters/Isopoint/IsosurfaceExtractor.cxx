// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/IsosurfaceExtractor.h"

#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Extraction/Thinning.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Splat/SplatGeometry.h"

namespace isopoint
{

void IsosurfaceExtractor::clear()
{
  this->Held = Cloud<FloatSample>();
  this->ItemCount = 0;
}

std::size_t IsosurfaceExtractor::sampleCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.samples.size(); }, this->Held);
}

std::size_t IsosurfaceExtractor::skippedCount() const
{
  return std::visit([](const auto& cloud) { return cloud.tree.skipped; }, this->Held);
}

ExtractedIsosurface IsosurfaceExtractor::extract(
  const Execution& execution, const ExtractionRequest& request)
{
  return std::visit(
    [&](auto& cloud)
    {
      const double surfaceShare = request.splats ? 0.6 : 1.0;
      ExtractedIsosurface result;
      result.surface = extractIsosurface(partOf(execution, 0.0, surfaceShare), cloud.tree,
        cloud.neighborhoods, this->ItemCount, request.isosurface);
      thin(execution, request.minimumSpacing, result.surface);
      throwIfAborted(execution);
      if (request.splats)
      {
        const Isosurface& surface = result.surface;
        const Execution splatting = partOf(execution, surfaceShare, 1.0);
        const IsopointNeighbors neighbors(
          splatting, cloud.tree, cloud.neighborhoods, surface.leaves);
        const SampleExtents extents(cloud.tree);
        result.splats =
          computeSplats(splatting, { surface.positions, surface.decreasingEdges, surface.fits },
            neighbors, &extents, *request.splats);
      }
      result.surface.leaves = {};
      return result;
    },
    this->Held);
}

} // namespace isopoint
