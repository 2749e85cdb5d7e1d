// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SingleRank_h
#define isopoint_SingleRank_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/SingleTeam.h"
#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Extraction/ExtractionContext.h"
#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/NeighborhoodFits.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Tetrahedra/TreeRefinement.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, as the extraction of triangles sees them, where there is but one.
/// TriangleRanks has the same functions for several, where all of them but order() and isHome() are
/// collective.
template <class TSample>
class SingleRank : public SingleTeam
{
public:
  explicit SingleRank(SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  std::vector<BinaryIndex> refine(NarrowBand<TSample>& band) const { return band.refine(); }

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
