// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Extraction/ExtractIsosurface.h"
#include "Core/Extraction/IsopointNeighbors.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Extraction/WholeSurface.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Neighbors/SampleExtent.h"
#include "Core/Ranks/SharedRanks.h"
#include "Core/Ranks/SurfaceHalo.h"
#include "Core/Splat/SplatGeometry.h"
#include "Core/Splat/SplatPolygons.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Triangles/ExtractTriangles.h"
#include "Core/Triangles/OwnedTriangles.h"
#include "Core/Triangles/TriangleGeometry.h"
#include "Core/Triangles/VertexNormals.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Rings of ghost isopoints per rank (docs/ranks.md). Five suffice for splats of the first two
/// rings to be drawn completely. If shapes are computed, splatRings is used instead.
inline constexpr int pointGhostRings = 5;

/// Some isopoints, with their splats. @throws std::bad_alloc, Aborted
/// @param splats of all isopoints, among which `indices` chooses; or empty
template <class TSample>
ExtractedIsosurface withSplats(const Execution& execution, const SampleTree<TSample>& tree,
  Isosurface surface, const std::vector<Splat>& splats, const std::vector<std::size_t>& indices)
{
  ExtractedIsosurface result;
  result.surface = std::move(surface);
  result.surface.coincident = coincidentEnds(execution, tree, result.surface.leaves);
  result.surface.leaves = std::vector<EdgeLeaves>(); // free the memory
  result.splats = chosenOf(execution, splats, indices);
  return result;
}

/// The part of a surface of triangles that belongs to this rank. @throws std::bad_alloc, Aborted
/// @param all the whole surface, the same on all ranks
template <class TSample>
ExtractedIsosurface partOnRank(const Execution& execution, SharedRanks<TSample>& ranks,
  const SampleTree<TSample>& tree, const ExtractedIsosurface& all, int rings)
{
  const std::vector<std::size_t> vertexRanks = tabulated<std::size_t>(execution, all.surface.size(),
    [&](std::size_t vertex)
    {
      const EdgeLeaves& leaves = all.surface.leaves[all.surface.edgeBegin(vertex)];
      return ranks.ownerOf(lowerTreeIndex(tree, leaves));
    });
  const auto rank = static_cast<std::size_t>(ranks.processes().rank());
  OwnedTriangles owned = ownedTriangles(execution, all.triangles, vertexRanks, rank, rings);
  ExtractedIsosurface result = withSplats(execution, tree,
    chosenIsopoints(execution, all.surface, owned.vertices), all.splats, owned.vertices);
  result.normals = chosenOf(execution, all.normals, owned.vertices);
  result.areGhosts = std::move(owned.areGhosts);
  result.triangles = std::move(owned.triangles);
  result.areCaps = chosenOf(execution, all.areCaps, owned.triangleNumbers);
  result.ghostTriangles = owned.ghostCount;
  result.droppedInGaps = rank == 0 ? all.droppedInGaps : 0;
  return result;
}

template <class TSample, class TRanks>
ExtractedIsosurface findTriangles(const Execution& execution, SampleCloud<TSample>& cloud,
  TRanks& ranks, const ExtractionRequest& request)
{
  TriangleExtraction<TSample, TRanks> extraction(
    execution, cloud.tree, ranks, cloud.neighborhoods, cloud.keptTetrahedra, request.isosurface);
  TriangleSurface found = extraction.extract();
  ExtractedIsosurface result;
  result.surface = std::move(found.vertices);
  result.triangles = std::move(found.triangles);
  result.areCaps = std::move(found.areCaps);
  result.droppedInGaps = found.droppedTetrahedra;
  if (request.splats)
  {
    const Isosurface& surface = result.surface;
    result.normals =
      vertexNormals(execution, { surface.positions, surface.decreasingEdges, surface.fits },
        result.triangles, request.splats->fieldNormals, request.isosurface.caps);
  }
  return result;
}

template <class TSample>
ExtractedIsosurface extractTriangles(const Execution& execution, SampleCloud<TSample>& cloud,
  ProcessGroup* processes, const ExtractionRequest& request)
{
  if (processes)
  {
    SharedRanks<TSample> ranks(*processes, cloud.tree, cloud.begins);
    return partOnRank(execution, ranks, cloud.tree, findTriangles(execution, cloud, ranks, request),
      request.triangleGhostRings);
  }
  SingleRank<TSample> rank(cloud.tree);
  ExtractedIsosurface result = findTriangles(execution, cloud, rank, request);
  result.surface.leaves = std::vector<EdgeLeaves>(); // free the memory
  return result;
}

/// @tparam TSurroundings WholeSurface for one rank, SurfaceHalo for several
template <class TSurroundings, class TSample, class TRanks>
ExtractedIsosurface findPoints(const Execution& execution, SampleCloud<TSample>& cloud,
  TRanks& ranks, std::size_t itemCount, const ExtractionRequest& request,
  ExtractedIsosurface* ghosts)
{
  const double splatsBegin = request.splats ? 0.6 : 1.0; // share of the progress
  Isosurface found = extractIsosurface(partOf(execution, 0.0, splatsBegin), cloud.tree, ranks,
    cloud.neighborhoods, itemCount, request.isosurface);
  const bool hasFits = request.isosurface.fit.has_value();
  const std::size_t dropped = found.droppedEdges;
  throwIfAborted(execution);
  const Execution part = partOf(execution, splatsBegin, 1.0);
  TSurroundings surroundings(
    part, ranks, cloud.tree, cloud.neighborhoods, std::move(found), hasFits);
  const bool hasShapes = request.splats && request.splats->shapes;
  const bool looksAround = (request.splats || ghosts) && !cloud.tree.isEmpty();
  surroundings.gather(
    looksAround ? std::max(ghosts ? pointGhostRings : 3, hasShapes ? splatRings : 3) : 0,
    ghosts != nullptr);
  std::vector<Splat> splats;
  if (request.splats && looksAround)
  {
    const Isosurface& all = surroundings.surface();
    const IsopointNeighbors<TSample> neighbors(
      part, cloud.tree, cloud.neighborhoods, all.leaves, surroundings.inner());
    const SampleExtents<TSample> extents(cloud.tree);
    splats = computeSplats(part,
      { all.positions, all.decreasingEdges, all.fits, surroundings.numbers(), all.isovalue },
      neighbors, &extents, *request.splats, surroundings);
    if (ghosts)
    {
      surroundings.share(splats);
    }
  }
  if (ghosts)
  {
    const std::vector<std::size_t> elsewhere = surroundings.ghosts();
    *ghosts = withSplats(part, cloud.tree, chosenIsopoints(part, surroundings.surface(), elsewhere),
      splats, elsewhere);
    ghosts->areGhosts.resize(elsewhere.size(), true);
  }
  const std::vector<std::size_t> owned = surroundings.owned();
  ExtractedIsosurface result =
    withSplats(part, cloud.tree, surroundings.takeOwned(), splats, owned);
  result.droppedInGaps = dropped;
  return result;
}

template <class TSample>
ExtractedIsosurface extractFromCloud(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, ProcessGroup* processes, const ExtractionRequest& request,
  ExtractedIsosurface* ghosts)
{
  if (request.triangles)
  {
    return extractTriangles(execution, cloud, processes, request);
  }
  if (processes)
  {
    SharedRanks<TSample> ranks(*processes, cloud.tree, cloud.begins);
    return findPoints<SurfaceHalo<TSample>>(execution, cloud, ranks, itemCount, request, ghosts);
  }
  SingleRank<TSample> rank(cloud.tree);
  return findPoints<WholeSurface<TSample>>(execution, cloud, rank, itemCount, request, ghosts);
}

} // namespace isopoint
