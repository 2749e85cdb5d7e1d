// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_EdgeTeam_h
#define isopoint_EdgeTeam_h

#include "Isopoint/Extraction/CrossingEdge.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/TeamOfTree.h"
#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The ranks that share a tree, each with the crossing edges that end in its leaves: those between
/// two ranks are on both.
template <class TSample>
class EdgeTeam : public TeamOfTree<TSample>
{
public:
  using Edge = CrossingEdge<TSample>;

  /// @param edges of this rank, ordered, each once
  EdgeTeam(const SampleTree<TSample>& tree, NodeExchange<TSample>& exchange,
    const std::vector<Edge>& edges)
    : TeamOfTree<TSample>(exchange)
    , Tree(tree)
    , Edges(edges)
  {
  }

  /// Adds the numbers of those of this rank's edges that other ranks found, and orders all.
  void unite(std::vector<std::size_t>& found)
  {
    std::vector<std::vector<Ids>> outgoing;
    this->together([&]() { outgoing = this->sent(found); });
    const std::vector<std::vector<Ids>> arrived = this->Exchange.team().exchange(outgoing);
    this->together(
      [&]()
      {
        for (const std::vector<Ids>& list : arrived)
        {
          for (const Ids& ids : list)
          {
            const Edge wanted{ ids.first, ids.second, 0.0, 0, 0 };
            const auto edge = std::lower_bound(this->Edges.begin(), this->Edges.end(), wanted);
            found.push_back(static_cast<std::size_t>(edge - this->Edges.begin()));
          }
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
      });
  }

private:
  /// The ends of an edge.
  struct Ids
  {
    std::uint64_t first;
    std::uint64_t second;
  };

  /// What goes to each rank.
  std::vector<std::vector<Ids>> sent(const std::vector<std::size_t>& found) const
  {
    std::vector<std::vector<Ids>> outgoing(static_cast<std::size_t>(this->Exchange.team().size()));
    for (const std::size_t i : found)
    {
      for (const auto leaf : { this->Edges[i].firstLeaf, this->Edges[i].secondLeaf })
      {
        const Node<TSample>& node = this->Tree.nodes[leaf];
        if (!this->Tree.hasOwn(node))
        {
          outgoing[this->Exchange.ownerOf(node.begin)].push_back(
            { this->Edges[i].first, this->Edges[i].second });
        }
      }
    }
    return outgoing;
  }

  const SampleTree<TSample>& Tree;
  const std::vector<Edge>& Edges;
};

} // namespace isopoint

#endif
