// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SingleRank_h
#define isopoint_SingleRank_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Tetrahedra/TreeRefinement.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, as the extraction of triangles sees them, where there is but one,
/// which has all samples. TriangleRanks has the same functions for several, where all of them but
/// order() and isHome() are collective.
template <class TSample>
class SingleRank
{
public:
  explicit SingleRank(SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// Does this rank's share of some work, and returns once that of all is done; see Team.
  template <class Work>
  void together(const Work& work) const
  {
    work();
  }

  bool isAny(bool mine) const { return mine; }
  std::uint64_t sum(std::uint64_t mine) const { return mine; }

  std::vector<BinaryIndex> refine(NarrowBand<TSample>& band) const { return band.refine(); }

  /// Works on the items 0 .. count - 1, in parallel.
  /// @param makeWorker() what one thread needs to work on some items
  /// @param work(worker, item) is begun anew where it threw MissingNode: it must not leave anything
  /// behind then
  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, std::size_t count, const MakeWorker& makeWorker,
    const Work& work) const
  {
    constexpr std::size_t grain = 256;
    forBatches(execution, count, 8 * grain, grain,
      [&](std::size_t begin, std::size_t end)
      {
        auto worker = makeWorker();
        for (std::size_t i = begin; i < end; ++i)
        {
          work(worker, i);
        }
      });
  }

  /// Adds the leaves of all other ranks to those of this one, as leaves of its tree.
  void gatherLeaves(std::vector<std::size_t>& /*leaves*/) const {}

  /// Brings what all ranks have, each in an order of its own, into one order.
  template <class T>
  void order(std::vector<T>& /*tetrahedra*/) const
  {
  }

  /// Whether what belongs to leaves, the one that comes first in the order of the tree, is counted
  /// on this rank.
  bool isHome(std::size_t /*leaf*/) const { return true; }

  /// Sets the marks that are set on any rank.
  void unite(std::vector<char>& /*marks*/) const {}

  /// Fits to the samples around edges, which all ranks have. @returns one fit for each
  std::vector<LocalFit> fit(const Execution& execution, ExtractionContext<TSample>& context,
    const FitRequest& request, const std::vector<CrossingEdge<TSample>>& edges) const
  {
    this->splitAround(execution, leavesOf(edges));
    return fitNeighborhoods(execution, context, request, edges);
  }

private:
  /// Splits what touches leaves down to leaves, for fits: the band has done so around leaves that
  /// touch the other side, and ends of Delaunay edges may not be of these.
  void splitAround(const Execution& execution, const std::vector<std::size_t>& leaves) const
  {
    std::vector<std::size_t> missing;
    do
    {
      constexpr std::size_t grain = 1024;
      missing = collected<std::size_t>(execution, leaves.size(), grain,
        [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
        {
          for (std::size_t i = begin; i < end; ++i)
          {
            this->addUnsplitAround(leaves[i], found);
          }
        });
      splitFurther(execution, this->Tree, missing);
    } while (!missing.empty());
  }

  void addUnsplitAround(std::size_t leaf, std::vector<std::size_t>& unsplit) const
  {
    visitTouching(this->Tree, pathToLeaf(this->Tree, leaf), maximumDepth,
      [&](std::size_t node)
      {
        if (!this->Tree.nodes[node].isLeaf)
        {
          unsplit.push_back(node);
        }
        return false;
      });
  }

  SampleTree<TSample>& Tree;
};

} // namespace isopoint

#endif
