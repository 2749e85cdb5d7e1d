// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Neighbors/GapSpread.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Crossing edges as parts of a surface for GapSpread; edges with a common end are connected.
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

  template <class TRanks>
  void unite(TRanks& ranks, std::vector<std::size_t>& found) const
  {
    ranks.uniteEdges(this->Edges, found);
  }

  template <class Test>
  bool anyEdge(std::size_t edge, const Test& test) const
  {
    return test(static_cast<std::size_t>(this->Edges[edge].firstLeaf),
      static_cast<std::size_t>(this->Edges[edge].secondLeaf));
  }

  /// Visits the edges at both ends; skips ends that were visited before.
  template <class Visit>
  void forEachNeighbor(std::size_t edge, const Visit& visit)
  {
    if (this->Ends.empty())
    {
      this->listEnds();
    }
    for (const auto leaf : { this->Edges[edge].firstLeaf, this->Edges[edge].secondLeaf })
    {
      auto end = std::lower_bound(this->Ends.begin(), this->Ends.end(),
        std::pair(static_cast<std::size_t>(leaf), std::size_t{ 0 }));
      char& isVisited = this->IsVisited[static_cast<std::size_t>(end - this->Ends.begin())];
      for (; !isVisited && end != this->Ends.end() && end->first == static_cast<std::size_t>(leaf);
           ++end)
      {
        visit(end->second);
      }
      isVisited = 1;
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
    this->IsVisited.resize(this->Ends.size(), 0);
  }

  const std::vector<CrossingEdge<TSample>>& Edges;
  std::vector<std::pair<std::size_t, std::size_t>> Ends; // leaf and edge; once there is a gap
  std::vector<char> IsVisited;                           // by first entry of a leaf
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
  EdgeParts<TSample> parts(edges);
  GapSpread<TSample, TRanks, EdgeParts<TSample>> spread(execution, tree, ranks, parts);
  std::vector<std::size_t> seeds;
  for (const CrossingEdge<TSample>& edge : strong)
  {
    const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
    seeds.push_back(static_cast<std::size_t>(found - edges.begin()));
  }
  keepUnique(seeds);
  parts.unite(ranks, seeds);
  spread.spread(GapCriterion::weak(), std::move(seeds));
  return spread.takeInGap();
}

} // namespace isopoint
