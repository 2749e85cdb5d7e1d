// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Splat/CellCutter.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatCell.h"
#include "Isopoint/Splat/SplatFans.h"
#include "Isopoint/Splat/SplatNormals.h"

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// Normals and shapes of splats for the points of one surface; see docs/algorithm.md, section 12.
///
/// @param points close ones best after each other
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
/// @param extents of the samples, or null: then no border is known; see cutAtBorder()
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
  forBatches(
    execution, unfitted.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      PlaneNormals<TNeighbors> normals(neighbors, points, options.neighborCount);
      for (std::size_t i = begin; i < end; ++i)
      {
        splats[unfitted[i]].normal = normals.at(unfitted[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare * share); });
  if (!options.shapes)
  {
    return splats;
  }
  constexpr double cellsShare = 0.4;
  std::vector<SplatCell> cells(splats.size());
  forBatches(
    execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      CellCutter<TNeighbors, TExtents> cutter(neighbors, points, extents, splats);
      for (std::size_t i = begin; i < end; ++i)
      {
        cells[i] = cutter.cut(i);
      }
    },
    [&](double share) { execution.progress(normalsShare + cellsShare * share); });
  std::vector<std::size_t> all(splats.size());
  std::iota(all.begin(), all.end(), std::size_t{ 0 });
  shapeSplats(
    partOf(execution, normalsShare + cellsShare, 1.0), points, std::move(cells), all, splats);
  return splats;
}

} // namespace isopoint

#endif
