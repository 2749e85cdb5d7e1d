// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractFromCloud_h
#define isopoint_ExtractFromCloud_h

#include "Isopoint/Extraction/ExpectedWork.h"
#include "Isopoint/Extraction/ExtractIsosurface.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Extraction/Thinning.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Ranks/ExtractOnRanks.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/RankSplats.h"
#include "Isopoint/Ranks/RankSurface.h"
#include "Isopoint/Ranks/SurfaceHalo.h"
#include "Isopoint/Ranks/TriangleRanks.h"
#include "Isopoint/SampleCloud.h"
#include "Isopoint/Splat/SplatFans.h"
#include "Isopoint/Splat/SplatGeometry.h"
#include "Isopoint/Tetrahedra/SingleRank.h"
#include "Isopoint/Triangles/ExtractTriangles.h"
#include "Isopoint/Triangles/SurfacePart.h"
#include "Isopoint/Triangles/TriangleGeometry.h"

#include <algorithm>

namespace isopoint
{

/// Of neighbors around a rank's isopoints that are its ghosts: where splats of the second ring are
/// seen, so are those that they overlap (docs/ranks.md).
inline constexpr int ghostRings = 5;

/// The isopoints of a rank that are on it, or its ghosts, with their splats, if there are any.
template <class TSample>
ExtractedIsosurface chosen(const SampleTree<TSample>& tree, const Isosurface& all,
  const std::vector<Splat>& splats, const std::vector<bool>& isHome, bool areHome)
{
  ExtractedIsosurface result;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (isHome[i] == areHome)
    {
      indices.push_back(i);
      if (!splats.empty())
      {
        result.splats.push_back(splats[i]);
      }
    }
  }
  result.surface = chosenIsopoints(all, indices);
  result.surface.coincident = coincidentEnds(tree, result.surface.leaves);
  result.surface.leaves = {};
  result.areElsewhere.resize(areHome ? 0 : result.surface.size(), true);
  return result;
}

/// The part of a surface of triangles that is on this rank.
/// @param all what is found on each of them
template <class TSample>
ExtractedIsosurface partOnRank(
  NodeExchange<TSample>& exchange, const ExtractedIsosurface& all, int rings)
{
  const SampleTree<TSample>& tree = exchange.tree();
  std::vector<std::size_t> vertexRanks;
  for (const EdgeLeaves& leaves : all.surface.leaves)
  {
    vertexRanks.push_back(exchange.ownerOf(firstPlaceOf(tree, leaves)));
  }
  const auto rank = static_cast<std::size_t>(exchange.team().rank());
  SurfacePart part = SurfacePartChoice(all.triangles, vertexRanks, rank).choose(rings);
  ExtractedIsosurface result;
  result.surface = chosenIsopoints(all.surface, part.vertices);
  result.surface.coincident = coincidentEnds(tree, result.surface.leaves);
  result.surface.leaves = {};
  for (std::size_t i = 0; i < part.vertices.size() && !all.splats.empty(); ++i)
  {
    result.splats.push_back(all.splats[part.vertices[i]]);
  }
  result.areElsewhere = std::move(part.areElsewhere);
  result.triangles = std::move(part.triangles);
  result.ghostTriangles = part.ghostCount;
  result.droppedInGaps = rank == 0 ? all.droppedInGaps : 0;
  return result;
}

template <class TSample, class TRanks>
ExtractedIsosurface findTriangles(const Execution& execution, SampleCloud<TSample>& cloud,
  TRanks& ranks, const ExtractionRequest& request)
{
  WorkProgress progress(execution);
  TriangleExtraction<TSample, TRanks> extraction(
    execution, cloud.tree, ranks, cloud.neighborhoods, request.isosurface);
  TriangleSurface found = extraction.extract(progress, work::writing);
  ExtractedIsosurface result;
  ranks.together(
    [&]()
    {
      throwIfAborted(execution);
      result.surface = std::move(found.vertices);
      result.triangles = std::move(found.triangles);
      result.droppedInGaps = found.droppedTetrahedra;
      if (request.splats)
      {
        const Isosurface& surface = result.surface;
        result.splats = vertexNormals({ surface.positions, surface.decreasingEdges, surface.fits },
          result.triangles, request.splats->fieldNormals);
      }
    });
  return result;
}

template <class TSample>
ExtractedIsosurface extractTriangles(
  const Execution& execution, SampleCloud<TSample>& cloud, const ExtractionRequest& request)
{
  SingleRank<TSample> rank(cloud.tree);
  ExtractedIsosurface result = findTriangles(execution, cloud, rank, request);
  result.surface.leaves = {};
  return result;
}

template <class TSample>
ExtractedIsosurface extractTrianglesOnRanks(const Execution& execution, SampleCloud<TSample>& cloud,
  Team& team, const ExtractionRequest& request)
{
  NodeExchange<TSample> exchange(team, cloud.tree, cloud.begins);
  TriangleRanks<TSample> ranks(cloud.tree, exchange);
  const ExtractedIsosurface all = findTriangles(execution, cloud, ranks, request);
  ExtractedIsosurface result;
  exchange.together([&]() { result = partOnRank(exchange, all, request.ghostRings); });
  return result;
}

template <class TSample>
ExtractedIsosurface extractOnRanks(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, Team& team, const ExtractionRequest& request, ExtractedIsosurface* ghosts)
{
  WorkProgress progress(execution);
  NodeExchange<TSample> exchange(team, cloud.tree, cloud.begins);
  RankSurface<TSample> ofRank(execution, cloud.tree, exchange, cloud.neighborhoods, itemCount);
  const double splatting = request.splats ? work::splatting : 0.0;
  Isosurface surface = ofRank.extract(request.isosurface, progress, splatting + work::writing);
  const bool hasFits = request.isosurface.fit.has_value();
  if (request.minimumSpacing > 0.0 && hasFits)
  {
    keepOnRanks(execution, team, request.minimumSpacing, surface);
  }
  const auto count = static_cast<double>(surface.size());
  const Execution part = progress.part(count * splatting, count * work::writing);
  SurfaceHalo<TSample> halo(part, exchange, cloud.neighborhoods, surface, hasFits);
  const bool hasHalo = (ghosts || request.splats) && !cloud.tree.isEmpty();
  if (hasHalo)
  {
    const bool hasShapes = request.splats && request.splats->shapes;
    halo.gather(std::max(ghosts ? ghostRings : 3, hasShapes ? fanRings : 3));
  }
  const Isosurface& all = hasHalo ? halo.surface() : surface;
  std::vector<bool> isShaped;
  std::vector<bool> isHome; // of all of them
  exchange.together(
    [&]()
    {
      isHome.resize(all.size(), false);
      for (std::size_t i = 0; i < surface.size(); ++i)
      {
        const auto place = firstPlaceOf(cloud.tree, surface.leaves[i]);
        const bool isOnThisRank = place >= cloud.tree.ownBegin && place < cloud.tree.ownEnd;
        isHome[hasHalo ? halo.ownIndices()[i] : i] = isOnThisRank;
        // Either rank of an edge between two sends such a ghost.
        isShaped.push_back(isOnThisRank || ghosts);
      }
    });
  std::vector<Splat> splats;
  if (hasHalo && request.splats)
  {
    splats = RankSplats<TSample>(part, exchange, cloud.neighborhoods, *request.splats)
               .compute(halo, isShaped, ghosts != nullptr);
  }
  ExtractedIsosurface result;
  exchange.together(
    [&]()
    {
      result = chosen(cloud.tree, all, splats, isHome, true);
      result.droppedInGaps = surface.droppedEdges;
      if (ghosts)
      {
        *ghosts = chosen(cloud.tree, all, splats, isHome, false);
      }
    });
  return result;
}

/// The splats of all isopoints of a surface.
template <class TSample>
std::vector<Splat> splatsOf(const Execution& execution, const SampleCloud<TSample>& cloud,
  const Isosurface& surface, const SplatOptions& options)
{
  // Close points come after each other, so that what lies around them is in the caches.
  const std::vector<std::size_t> order = inOrderOfLeaves(surface.leaves, cloud.tree.nodes.size());
  const Isosurface ordered = chosenIsopoints(surface, order);
  const IsopointNeighbors neighbors(execution, cloud.tree, cloud.neighborhoods, ordered.leaves);
  const SampleExtents extents(cloud.tree);
  const std::vector<Splat> found = computeSplats(execution,
    { ordered.positions, ordered.decreasingEdges, ordered.fits, order, ordered.isovalue },
    neighbors, &extents, options);
  std::vector<Splat> splats(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    splats[order[i]] = found[i];
  }
  return splats;
}

template <class TSample>
ExtractedIsosurface extractPoints(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, const ExtractionRequest& request)
{
  WorkProgress progress(execution);
  const double splatting = request.splats ? work::splatting : 0.0;
  ExtractedIsosurface result;
  result.surface = extractIsosurface(execution, cloud.tree, cloud.neighborhoods, itemCount,
    request.isosurface, progress, splatting + work::writing);
  result.droppedInGaps = result.surface.droppedEdges;
  thin(execution, request.minimumSpacing, result.surface);
  throwIfAborted(execution);
  if (request.splats)
  {
    const auto count = static_cast<double>(result.surface.size());
    const Execution part = progress.part(count * splatting, count * work::writing);
    result.splats = splatsOf(part, cloud, result.surface, *request.splats);
  }
  result.surface.leaves = {};
  return result;
}

template <class TSample>
ExtractedIsosurface extractFromCloud(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, Team* team, const ExtractionRequest& request, ExtractedIsosurface* ghosts)
{
  if (team && !request.triangles)
  {
    return extractOnRanks(execution, cloud, itemCount, *team, request, ghosts);
  }
  if (ghosts)
  {
    *ghosts = ExtractedIsosurface();
    ghosts->surface.isovalue = request.isosurface.isovalue;
  }
  if (team)
  {
    return extractTrianglesOnRanks(execution, cloud, *team, request);
  }
  return request.triangles ? extractTriangles(execution, cloud, request)
                           : extractPoints(execution, cloud, itemCount, request);
}

} // namespace isopoint

#endif
