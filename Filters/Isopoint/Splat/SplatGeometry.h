// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Splat/CellCutter.h"
#include "Isopoint/Splat/MutualSides.h"
#include "Isopoint/Splat/NearbyPoints.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatCell.h"
#include "Isopoint/Splat/SplatFans.h"
#include "Isopoint/Splat/SplatNormals.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Normals and shapes of splats for the points of one surface; see docs/algorithm.md, section 12.
///
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
/// @param extents of the samples, or null: then no border is known; see SplatBorder
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), and what the few requests of extents take.
template <class TNeighbors, class TExtents>
std::vector<Splat> computeSplats(const Execution& execution, const SurfacePoints& points,
  const TNeighbors& neighbors, const TExtents* extents, const SplatOptions& options)
{
  std::vector<Splat> splats(points.positions.size());
  const std::vector<std::size_t> unfitted = setFieldNormals(points, options, splats);
  throwIfAborted(execution);
  const double normalsShare = options.shapes ? 0.4 : 1.0;
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  const auto count = static_cast<std::size_t>(options.neighborCount);
  forBatches(
    execution, unfitted.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      NearbyPoints<TNeighbors> nearby(neighbors, points.positions);
      std::vector<std::size_t> around;
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t point = unfitted[i];
        nearby.nearest(point, lengthOf(points.decreasingEdges[point]), count, around);
        splats[point].normal = planeNormal(points, point, around);
      }
    },
    [&](double share) { execution.progress(normalsShare * share); });
  if (!options.shapes)
  {
    return splats;
  }
  constexpr double cellsShare = 0.4;
  const std::vector<std::size_t> order = neighbors.inOrder();
  std::vector<SplatCell> cells(splats.size());
  forBatches(
    execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      CellCutter<TNeighbors, TExtents> cutter(neighbors, points, extents, splats);
      for (std::size_t i = begin; i < end; ++i)
      {
        cells[order[i]] = cutter.cut(order[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare + cellsShare * share); });
  std::vector<SplatCell> mutual(splats.size());
  forBatches(execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        mutual[i] = withMutualSides(cells, i);
      }
    });
  const SplatFans fans(points.positions, splats, mutual);
  const double fansBegin = normalsShare + cellsShare;
  forBatches(
    execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        fans.shape(order[i], splats[order[i]]);
      }
    },
    [&](double share) { execution.progress(fansBegin + (1.0 - fansBegin) * share); });
  return splats;
}

} // namespace isopoint

#endif
