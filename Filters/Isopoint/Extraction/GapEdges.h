// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_GapEdges_h
#define isopoint_GapEdges_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/SingleTeam.h"
#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Neighbors/GapCriterion.h"
#include "Isopoint/Neighbors/GapSpread.h"
#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// Crossing edges as parts of a surface for GapSpread: those with an end in common are connected.
template <class TSample>
class EdgeParts
{
public:
  /// @param edges each once
  explicit EdgeParts(const std::vector<CrossingEdge<TSample>>& edges)
    : Edges(edges)
  {
  }

  std::size_t size() const { return this->Edges.size(); }
  bool isCounted(std::size_t) const { return true; }

  template <class Test>
  bool anyEdge(std::size_t edge, const Test& test) const
  {
    return test(static_cast<std::size_t>(this->Edges[edge].firstLeaf),
      static_cast<std::size_t>(this->Edges[edge].secondLeaf));
  }

  template <class Visit>
  void forEachNeighbor(std::size_t edge, const Visit& visit)
  {
    if (this->Ends.empty())
    {
      this->listEnds();
    }
    for (const auto leaf : { this->Edges[edge].firstLeaf, this->Edges[edge].secondLeaf })
    {
      auto end = std::lower_bound(
        this->Ends.begin(), this->Ends.end(), std::pair(static_cast<std::size_t>(leaf), std::size_t{ 0 }));
      for (; end != this->Ends.end() && end->first == static_cast<std::size_t>(leaf); ++end)
      {
        visit(end->second);
      }
    }
  }

private:
  void listEnds()
  {
    this->Ends.reserve(2 * this->Edges.size());
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      this->Ends.emplace_back(static_cast<std::size_t>(this->Edges[i].firstLeaf), i);
      this->Ends.emplace_back(static_cast<std::size_t>(this->Edges[i].secondLeaf), i);
    }
    std::sort(this->Ends.begin(), this->Ends.end());
  }

  const std::vector<CrossingEdge<TSample>>& Edges;
  std::vector<std::pair<std::size_t, std::size_t>> Ends; // leaf and edge; once there is a gap
};

/// Which crossing edges lie in gaps of the cloud: docs/algorithm.md, section 6. Where several ranks
/// share the tree, this is collective.
/// @param edges each once
/// @param ranks SingleTeam, or TeamOfEdges
/// @throws std::bad_alloc, Aborted, FailedElsewhere
template <class TSample, class TRanks>
std::vector<char> edgesInGaps(const Execution& execution, const SampleTree<TSample>& tree,
  TRanks& ranks, const std::vector<CrossingEdge<TSample>>& edges)
{
  EdgeParts<TSample> parts(edges);
  GapSpread<TSample, TRanks, EdgeParts<TSample>> spread(execution, tree, ranks, parts);
  std::vector<std::size_t> all;
  ranks.together(
    [&]()
    {
      all.resize(edges.size());
      std::iota(all.begin(), all.end(), std::size_t{ 0 });
    });
  spread.spread(spread.over(GapCriterion::strong(), all));
  return spread.isInGap();
}

} // namespace isopoint

#endif
