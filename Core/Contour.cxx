// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Contour.h"

#include <algorithm>
#include <iterator>

namespace isopoint
{

std::vector<ExtractedIsosurface> extractIsovalues(const Execution& execution,
  IsosurfaceExtractor& extractor, const Options& options, int ghostRings, Report& report)
{
  const std::size_t count = report.isovalues.size();
  ExtractionRequest request = requestOf(options);
  request.triangleGhostRings = ghostRings;
  const bool hasGhosts = extractor.isOnRanks() && ghostRings > 0 && !request.triangles;
  std::vector<ExtractedIsosurface> surfaces;
  std::vector<ExtractedIsosurface> ghosts(hasGhosts ? count : 0);
  surfaces.reserve(count + ghosts.size());
  const auto shareAt = [count](std::size_t i)
  { return static_cast<double>(i) / static_cast<double>(count); };
  for (std::size_t i = 0; i < count; ++i)
  {
    request.isosurface.isovalue = report.isovalues[i];
    request.isosurface.keepsTetrahedra = i + 1 < count || options.keepTetrahedra;
    surfaces.push_back(extractor.extract(
      partOf(execution, shareAt(i), shareAt(i + 1)), request, hasGhosts ? &ghosts[i] : nullptr));
    report.countSurface(i, surfaces.back());
    throwIfAborted(execution);
  }
  std::move(ghosts.begin(), ghosts.end(), std::back_inserter(surfaces));
  return surfaces;
}

} // namespace isopoint
