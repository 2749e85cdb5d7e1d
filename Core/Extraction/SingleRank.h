// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/NeighborhoodFits.h"
#include "Core/Tree/TreeRefinement.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The process group as extraction sees it (template parameter TRanks), for one rank that has all
/// samples. SharedRanks implements the same functions for several ranks: there all but order() are
/// collective, and may throw FailedElsewhere in addition.
template <class TSample>
class SingleRank
{
public:
  using Edges = std::vector<CrossingEdge<TSample>>;

  explicit SingleRank(SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  bool isAny(bool mine) const { return mine; }
  std::uint64_t sum(std::uint64_t mine) const { return mine; }

  /// Fetches the nodes at a depth below missing ones that touch their boxes, with value ranges.
  /// Clears the list. @returns whether any rank missed any
  bool fetchNodes(std::vector<MissingNode>& /*missing*/, int /*depth*/) const { return false; }

  /// forEachItem() over the items 0 .. count - 1; items that miss samples of other ranks are
  /// repeated once these are fetched.
  /// @param work(worker, item) must have no effect if it throws MissingNode
  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone = ignoreShare) const
  {
    forEachItem(execution, batches, makeWorker, work, batchDone);
  }

  /// Adds the edges that end in leaves of this rank and were found by others.
  void shareEdges(Edges& /*edges*/) const {}

  /// Adds the indices of this rank's edges that other ranks found, and sorts all.
  void uniteEdges(const Edges& /*edges*/, std::vector<std::size_t>& /*found*/) const {}

  /// Adds the leaves of all other ranks, as leaves of this rank's tree.
  void gatherLeaves(std::vector<std::size_t>& /*leaves*/) const {}

  /// Sorts a list that all ranks have, each in its own order, into one order.
  template <class T>
  void order(std::vector<T>& /*tetrahedra*/) const
  {
  }

  /// Adds indices that other ranks found in a list that is equal on all ranks, and sorts all.
  void unite(std::vector<std::size_t>& /*found*/) const {}

  /// Fits to the samples around edges, the same on all ranks. @returns one fit per edge
  /// @param starts see fitAt()
  std::vector<LocalFit> fitShared(const Execution& execution, ExtractionContext<TSample>& context,
    const FitRequest& request, const Edges& edges, const std::vector<Vector>& starts)
  {
    constexpr double splitEnd = 0.2; // share of the progress
    this->splitAround(
      partOf(execution, 0.0, splitEnd), leavesOf(execution, edges, this->Tree.nodes.size()));
    return fitNeighborhoods(
      partOf(execution, splitEnd, 1.0), context, *this, request, edges, starts);
  }

private:
  /// Splits the neighbors of leaves down to leaves, for fits. The band has done so only around
  /// leaves that touch the other side; ends of Delaunay edges may be elsewhere.
  void splitAround(const Execution& execution, const std::vector<std::size_t>& leaves) const
  {
    splitWhileUnsplit(
      execution, this->Tree, leaves.size(),
      [&](std::size_t i, std::vector<std::size_t>& unsplit)
      {
        visitTouching(this->Tree, pathToNode(this->Tree, leaves[i]), maximumDepth,
          [&](std::size_t node)
          {
            if (!this->Tree.nodes[node].isLeaf)
            {
              unsplit.push_back(node);
            }
            return false;
          });
      },
      execution.progress);
  }

  SampleTree<TSample>& Tree;
};

} // namespace isopoint
