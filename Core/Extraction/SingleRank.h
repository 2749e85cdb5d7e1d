// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SingleRank_h
#define isopoint_SingleRank_h

#include "Core/Base/Execution.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/NeighborhoodFits.h"
#include "Core/Extraction/Thinning.h"
#include "Core/Tree/TreeRefinement.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, as extraction sees them, where there is one: it has all samples.
/// SharedRanks has the same functions for several. There all of them are collective, except
/// order(), and throw FailedElsewhere besides what is stated here.
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

  /// Fetches the nodes of a depth below the missing ones, as far as they touch their boxes, with
  /// their ranges of values. Empties the list. @returns whether any rank missed any
  bool fetchNodes(std::vector<MissingNode>& /*missing*/, int /*depth*/) const { return false; }

  /// Works on the items 0 .. count - 1, in parallel; see forEachItem(). An item that misses samples
  /// of other ranks is begun anew once these have been fetched.
  /// @param work(worker, item) must not leave anything behind where it throws MissingNode
  template <class MakeWorker, class Work>
  void forEach(
    const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone = [](double) {}) const
  {
    forEachItem(execution, batches, makeWorker, work, batchDone);
  }

  /// Adds the edges that other ranks found and that end in leaves of this one.
  void shareEdges(Edges& /*edges*/) const {}

  /// Adds the numbers of those of this rank's edges that other ranks found, and orders all.
  void uniteEdges(const Edges& /*edges*/, std::vector<std::size_t>& /*found*/) const {}

  /// See thin().
  void thinOut(const Execution& execution, double minimumSpacing, Isosurface& surface) const
  {
    thin(execution, minimumSpacing, surface);
  }

  /// Adds the leaves of all other ranks to those of this one, as leaves of its tree.
  void gatherLeaves(std::vector<std::size_t>& /*leaves*/) const {}

  /// Brings what all ranks have, each in an order of its own, into one order.
  template <class T>
  void order(std::vector<T>& /*tetrahedra*/) const
  {
  }

  /// Adds the numbers of things that all ranks have in one order and other ranks found, and orders
  /// all.
  void unite(std::vector<std::size_t>& /*found*/) const {}

  /// Fits to the samples around edges, which all ranks have. @returns one fit for each
  /// @param starts see fitAt()
  std::vector<LocalFit> fitShared(const Execution& execution, ExtractionContext<TSample>& context,
    const FitRequest& request, const Edges& edges, const std::vector<Vector>& starts)
  {
    constexpr double splitEnd = 0.2; // share of the progress
    this->splitAround(partOf(execution, 0.0, splitEnd), leavesOf(edges));
    return fitNeighborhoods(
      partOf(execution, splitEnd, 1.0), context, *this, request, edges, starts);
  }

private:
  /// Splits what touches leaves down to leaves, for fits: the band has done so around leaves that
  /// touch the other side, and ends of Delaunay edges may not be of these.
  void splitAround(const Execution& execution, const std::vector<std::size_t>& leaves) const
  {
    splitWhileUnsplit(
      execution, this->Tree, leaves.size(),
      [&](std::size_t i, std::vector<std::size_t>& unsplit)
      {
        visitTouching(this->Tree, pathToLeaf(this->Tree, leaves[i]), maximumDepth,
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

#endif
