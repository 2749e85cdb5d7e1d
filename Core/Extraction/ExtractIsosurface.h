// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/EdgeFinder.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/NarrowBand.h"
#include "Core/Extraction/NeighborhoodFits.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleBounds.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// Results from the leaves near an isosurface.
template <class TSample>
struct FoundEdges
{
  std::vector<CrossingEdge<TSample>> edges;    // each once or twice, in any order
  std::vector<CrossingEdge<TSample>> gapEdges; // rejected by the strong gap criterion, if wanted
  std::vector<std::vector<typename TSample::Id>> neighborhoods; // for NeighborhoodCache::add()
};

/// Work that waits for samples of other ranks.
struct MissingWork
{
  std::vector<BinaryIndex> leaves;  // whose edges are not found yet
  std::vector<MissingNode> missing; // to fetch first
};

/// Finds the crossing edges of all this rank's leaves below the given nodes.
/// @returns leaves that wait for samples
/// @throws Aborted, std::bad_alloc
template <class TSample>
MissingWork addEdges(const Execution& execution, ExtractionContext<TSample>& context,
  const IsosurfaceRequest& request, const std::vector<BinaryIndex>& nodes,
  FoundEdges<TSample>& result)
{
  const AngleCriterion criterion(request.angle);
  MissingWork left;
  std::mutex mutex;
  constexpr std::size_t grain = 256;
  forBatches(
    execution, nodes.size(), 8 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      EdgeFinder<TSample> finder(context, criterion, request.dropsGaps);
      const auto findAt = [&](const Path& leaf)
      {
        if (!context.tree.hasOwn(context.tree.nodes[leaf.nodeIndex()]))
        {
          return;
        }
        try
        {
          finder.find(leaf);
        }
        catch (const MissingNode& missing)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          left.leaves.push_back(leaf.index);
          left.missing.push_back(missing);
        }
      };
      Path path = pathToRoot(context.tree);
      for (std::size_t i = begin; i < end; ++i)
      {
        moveTo(context.tree, path, nodes[i]);
        forEachBelow(context.tree, path, maximumDepth, findAt);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      result.edges.insert(result.edges.end(), finder.edges().begin(), finder.edges().end());
      result.gapEdges.insert(
        result.gapEdges.end(), finder.gapEdges().begin(), finder.gapEdges().end());
      result.neighborhoods.push_back(std::move(finder.records()));
    },
    execution.progress);
  return left;
}

/// The crossing edges with an end in this rank's leaves below the given nodes. Collective.
/// @param ranks SingleRank or SharedRanks
/// @throws Aborted, std::bad_alloc
template <class TSample, class TRanks>
FoundEdges<TSample> findEdges(const Execution& execution, ExtractionContext<TSample>& context,
  TRanks& ranks, const IsosurfaceRequest& request, std::vector<BinaryIndex> nodes)
{
  FoundEdges<TSample> found;
  MissingWork left;
  do
  {
    left = addEdges(execution, context, request, nodes, found);
    nodes = std::move(left.leaves);
  } while (ranks.fetchNodes(left.missing, maximumDepth + 1));
  ranks.shareEdges(found.edges);
  return found;
}

/// Crossing edges as the elements of GapSpread; edges with a common end are connected.
template <class TSample>
class ConnectedEdges
{
public:
  /// @param edges each once
  /// @param nodeCount of the tree
  ConnectedEdges(const std::vector<CrossingEdge<TSample>>& edges, std::size_t nodeCount)
    : Edges(edges)
    , NodeCount(nodeCount)
  {
  }

  std::size_t size() const { return this->Edges.size(); }

  void connect(const Execution& execution, const std::vector<std::size_t>& edges)
  {
    if (!this->EdgesAt && !edges.empty())
    {
      this->IsVisited.resize(this->NodeCount, 0);
      this->EdgesAt.emplace(execution, this->NodeCount, this->size(),
        [this](std::size_t i) { return this->leavesOf(i); });
    }
  }

  /// Visits the edges at both ends; skips ends that were visited before.
  template <class Visit>
  void forEachNeighbor(std::size_t edge, const Visit& visit)
  {
    for (const std::size_t leaf : this->leavesOf(edge))
    {
      if (!this->IsVisited[leaf])
      {
        const IndexSpan<std::size_t> edges = this->EdgesAt->at(leaf);
        std::for_each(edges.begin(), edges.end(), visit);
        this->IsVisited[leaf] = 1;
      }
    }
  }

private:
  std::array<std::size_t, 2> leavesOf(std::size_t edge) const
  {
    return { static_cast<std::size_t>(this->Edges[edge].firstLeaf),
      static_cast<std::size_t>(this->Edges[edge].secondLeaf) };
  }

  const std::vector<CrossingEdge<TSample>>& Edges;
  const std::size_t NodeCount;
  // By leaf, once there is a gap.
  std::optional<ItemLists> EdgesAt;
  std::vector<char> IsVisited;
};

/// By edge, whether it lies in a gap of the cloud (docs/algorithm.md, section 6). Collective.
/// @param edges sorted, each once
/// @param strong edges that the strong gap criterion rejects, in any order, with repetitions
/// @param ranks SingleRank or SharedRanks
/// @throws std::bad_alloc, Aborted, FailedElsewhere
template <class TSample, class TRanks>
std::vector<char> edgesInGaps(const Execution& execution, const SampleTree<TSample>& tree,
  TRanks& ranks, const std::vector<CrossingEdge<TSample>>& edges,
  const std::vector<CrossingEdge<TSample>>& strong)
{
  ConnectedEdges<TSample> connected(edges, tree.nodes.size());
  GapSpread<TRanks, ConnectedEdges<TSample>> spread(execution, ranks, connected);
  std::vector<std::size_t> seeds(strong.size());
  forEachIndex(execution, strong.size(),
    [&](std::size_t i)
    {
      const auto found = std::lower_bound(edges.begin(), edges.end(), strong[i]);
      seeds[i] = static_cast<std::size_t>(found - edges.begin());
    });
  seeds = sortedUnique(execution, seeds, edges.size());
  ranks.uniteEdges(edges, seeds);
  SampleBounds<TSample> bounds(tree);
  spread.spread(std::move(seeds),
    [&](const std::vector<std::size_t>& some)
    {
      std::vector<std::size_t> weak = chosenOf(execution, some,
        itemsThat(execution, ranks, some.size(),
          [&](std::size_t i)
          {
            return GapCriterion::weak().rejects(tree, bounds,
              tree.sampleOf(edges[some[i]].firstLeaf), tree.sampleOf(edges[some[i]].secondLeaf));
          }));
      ranks.uniteEdges(edges, weak);
      return weak;
    });
  return spread.takeMarks();
}

/// Drops the edges in gaps. @returns the number of dropped edges that belong to this rank
/// @param gapEdges see FoundEdges
template <class TSample, class TRanks>
std::size_t dropGapEdges(const Execution& execution, const SampleTree<TSample>& tree, TRanks& ranks,
  const std::vector<CrossingEdge<TSample>>& gapEdges, std::vector<CrossingEdge<TSample>>& edges)
{
  const std::vector<char> isInGap = edgesInGaps(execution, tree, ranks, edges, gapEdges);
  std::size_t count = 0;
  forEachInOrder(execution, edges.size(),
    [&](std::size_t i)
    {
      const EdgeLeaves leaves{ edges[i].firstLeaf, edges[i].secondLeaf };
      count += isInGap[i] && tree.isOwn(lowerTreeIndex(tree, leaves)) ? 1 : 0;
    });
  dropMarked(execution, isInGap, edges);
  return count;
}

/// Crossing edges of isopoints, sorted, each once.
template <class TSample>
struct IsopointEdges
{
  const std::vector<CrossingEdge<TSample>>& edges;
  const std::vector<std::size_t>& begins; // see Isosurface::edgeBegins
  /// Isopoints before they are moved; if empty, linear interpolation places them.
  const std::vector<Vector>& starts;
};

/// Makes isopoints of crossing edges. Each is at the position of its fit if one holds and `isMoved`
/// is true; otherwise at its start.
/// @param fits one per isopoint, or empty
template <class TSample>
Isosurface placeIsopoints(const Execution& execution, ExtractionContext<TSample>& context,
  const IsopointEdges<TSample>& isopoints, std::vector<LocalFit> fits, bool isMoved)
{
  Isosurface surface;
  surface.isovalue = context.isovalue;
  surface.edges.resize(isopoints.edges.size());
  surface.leaves.resize(isopoints.edges.size());
  surface.edgeBegins = isopoints.begins;
  surface.positions.resize(surface.size());
  surface.decreasingEdges.resize(surface.size());
  surface.fits = std::move(fits);
  const auto positionAt = [&context](typename TSample::Id leaf)
  { return positionOf(context.tree.sampleOf(leaf)); };
  forEachIndex(
    execution, surface.size(),
    [&](std::size_t i)
    {
      const std::size_t first = surface.edgeBegin(i);
      const CrossingEdge<TSample>& own = isopoints.edges[first];
      const Vector along = positionAt(own.secondLeaf) - positionAt(own.firstLeaf);
      const bool isDecreasing = !(context.leafValues.at(own.firstLeaf) < context.isovalue);
      surface.decreasingEdges[i] = isDecreasing ? along : -along;
      const auto crossingOf = [&](const CrossingEdge<TSample>& edge) {
        return interpolate(positionAt(edge.firstLeaf), positionAt(edge.secondLeaf), edge.crossing);
      };
      const bool followsFit = isMoved && surface.fits[i].order;
      const Vector start = isopoints.starts.empty() ? crossingOf(own) : isopoints.starts[i];
      surface.positions[i] = followsFit ? surface.fits[i].position : start;
      const Vector move = surface.positions[i] - start;
      const std::size_t last = surface.edgeBegin(i + 1);
      for (std::size_t k = first; k < last; ++k)
      {
        const CrossingEdge<TSample>& edge = isopoints.edges[k];
        const Vector crossing = last == first + 1 ? surface.positions[i] : crossingOf(edge) + move;
        const double parameter = followsFit ? nearestParameter(positionAt(edge.firstLeaf),
                                                positionAt(edge.secondLeaf), crossing)
                                            : edge.crossing;
        surface.edges[k] = { { edge.first, edge.second }, parameter };
        surface.leaves[k] = { edge.firstLeaf, edge.secondLeaf };
      }
    },
    execution.progress);
  return surface;
}

/// Adds neighborhoods to the known ones, as far as memory permits; others are searched again.
/// @throws Aborted
template <class TId>
void keepNeighborhoods(const Execution& execution, const std::vector<std::vector<TId>>& found,
  std::size_t nodeCount, NeighborhoodCache<TId>& neighborhoods)
{
  try
  {
    throwIfAborted(execution);
    neighborhoods.add(execution, found, nodeCount);
  }
  catch (const std::bad_alloc&)
  {
  }
}

/// The canonical isosurface (docs/algorithm.md), without coincident samples. Refines the tree as
/// needed. Collective: a rank gets the isopoints on edges with an end in its leaves; those of edges
/// between two ranks are on both.
/// @param ranks SingleRank or SharedRanks
/// @param neighborhoods known ones of the tree's leaves; those found are added
/// @param idCount above every id
/// @throws Aborted, std::bad_alloc, TreeTooLarge (see NarrowBand); the arguments remain usable
template <class TSample, class TRanks>
Isosurface extractIsosurface(const Execution& execution, SampleTree<TSample>& tree, TRanks& ranks,
  NeighborhoodCache<typename TSample::Id>& neighborhoods, std::uint64_t idCount,
  const IsosurfaceRequest& request)
{
  Isosurface surface;
  surface.isovalue = request.isovalue;
  if (tree.isEmpty()) // on all ranks
  {
    return surface;
  }
  constexpr double fitsEnd = 0.95; // shares of the progress
  const double edgesEnd = request.fit ? 0.4 : fitsEnd;
  const double bandEnd = 0.7 * edgesEnd;
  const std::vector<BinaryIndex> crossing =
    NarrowBand<TSample>(tree, request.isovalue, partOf(execution, 0.0, bandEnd)).refine(ranks);
  ExtractionContext<TSample> context(tree, neighborhoods, request.isovalue);
  FoundEdges<TSample> found =
    findEdges(partOf(execution, bandEnd, edgesEnd), context, ranks, request, crossing);
  keepNeighborhoods(execution, found.neighborhoods, tree.nodes.size(), neighborhoods);
  std::vector<CrossingEdge<TSample>> edges = sortedUnique(
    execution, found.edges, idCount, [](const CrossingEdge<TSample>& edge) { return edge.first; });
  const std::size_t dropped =
    request.dropsGaps ? dropGapEdges(execution, tree, ranks, found.gapEdges, edges) : 0;
  std::vector<LocalFit> fits;
  if (request.fit)
  {
    fits = fitNeighborhoods(
      partOf(execution, edgesEnd, fitsEnd), context, ranks, *request.fit, edges, {});
  }
  surface = placeIsopoints<TSample>(partOf(execution, fitsEnd, 1.0), context, { edges, {}, {} },
    std::move(fits), request.fit && request.fit->move);
  surface.droppedEdges = dropped;
  return surface;
}

} // namespace isopoint
