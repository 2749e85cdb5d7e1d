// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Extraction/ExtractionContext.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/NeighborhoodFits.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Core/Ranks/NodeExchange.h"
#include "Core/Ranks/SentIsopoint.h"
#include "Core/Tetrahedra/PartialTriangulation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace isopoint
{

/// The process group of ranks that share a tree; see SingleRank for the functions' contracts.
template <class TSample>
class SharedRanks
{
public:
  using Edges = std::vector<CrossingEdge<TSample>>;

  /// @param begins see SharedTree
  SharedRanks(
    ProcessGroup& processes, SampleTree<TSample>& tree, const std::vector<std::uint64_t>& begins)
    : Processes(processes)
    , Tree(tree)
    , Begins(begins)
    , Exchange(processes, tree, begins)
  {
  }

  ProcessGroup& processes() { return this->Processes; }

  /// The rank that owns the sample with a tree index.
  std::size_t ownerOf(std::uint64_t treeIndex) const { return rankAt(this->Begins, treeIndex); }

  bool isAny(bool mine) { return this->Processes.isAny(mine); }
  std::uint64_t sum(std::uint64_t mine) { return this->Processes.sum(mine); }

  bool fetchNodes(std::vector<MissingNode>& missing, int depth)
  {
    return this->Exchange.fetchNodes(missing, depth);
  }

  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone = ignoreShare)
  {
    std::vector<std::size_t> items = iota(batches.count);
    std::vector<MissingNode> missing;
    do
    {
      std::vector<std::size_t> aside;
      std::mutex mutex;
      forEachItem(
        execution, { items.size(), batches.batchPerThread, batches.grain }, makeWorker,
        [&](auto& worker, std::size_t i)
        {
          try
          {
            work(worker, items[i]);
          }
          catch (const MissingNode& node)
          {
            const std::lock_guard<std::mutex> lock(mutex);
            aside.push_back(items[i]);
            missing.push_back(node);
          }
        },
        batchDone);
      std::sort(aside.begin(), aside.end());
      items.swap(aside);
    } while (this->fetchNodes(missing, maximumDepth + 1));
  }

  void shareEdges(Edges& edges)
  {
    std::vector<std::vector<SentEdge>> outgoing(this->rankCount());
    for (const CrossingEdge<TSample>& edge : edges)
    {
      this->forOtherRanks(edge,
        [&](std::size_t rank)
        {
          outgoing[rank].push_back({ edge.first, edge.second, edge.crossing,
            { sentEnd(this->Tree, edge.firstLeaf), sentEnd(this->Tree, edge.secondLeaf) } });
        });
    }
    const std::vector<SentEdge> open = united(this->Processes.exchange(outgoing));
    std::vector<SentEnd> ends;
    for (const SentEdge& edge : open)
    {
      ends.insert(ends.end(), { edge.ends[0], edge.ends[1] });
    }
    const std::vector<std::size_t> leaves = this->leavesAt(ends);
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      edges.push_back({ { open[i].first, open[i].second }, open[i].crossing,
        static_cast<typename TSample::Id>(leaves[2 * i]),
        static_cast<typename TSample::Id>(leaves[2 * i + 1]) });
    }
  }

  /// The leaves at ends of edges in this rank's tree. Collective.
  std::vector<std::size_t> leavesAt(const std::vector<SentEnd>& ends)
  {
    std::vector<std::size_t> leaves(ends.size());
    this->forEach(
      Execution(), { ends.size(), 1024, 256 }, []() { return 0; },
      [&](int, std::size_t i) { leaves[i] = leafAt(this->Tree, ends[i]); });
    return leaves;
  }

  void uniteEdges(const Edges& edges, std::vector<std::size_t>& found)
  {
    std::vector<std::vector<SampleEdge>> outgoing(this->rankCount());
    for (const std::size_t i : found)
    {
      this->forOtherRanks(edges[i],
        [&](std::size_t rank) {
          outgoing[rank].push_back({ edges[i].first, edges[i].second });
        });
    }
    for (const SampleEdge& wanted : united(this->Processes.exchange(outgoing)))
    {
      const auto edge = std::lower_bound(edges.begin(), edges.end(), wanted);
      if (edge == edges.end() || wanted < *edge)
      {
        throw std::logic_error("ranks have found different edges");
      }
      found.push_back(static_cast<std::size_t>(edge - edges.begin()));
    }
    keepUnique(found);
  }

  void gatherLeaves(std::vector<std::size_t>& leaves)
  {
    std::vector<SentEnd> own;
    own.reserve(leaves.size());
    for (const std::size_t leaf : leaves)
    {
      own.push_back(sentEnd(this->Tree, leaf));
    }
    std::vector<std::vector<SentEnd>> all = this->Processes.gather(own);
    all[static_cast<std::size_t>(this->Processes.rank())].clear();
    const std::vector<std::size_t> others = this->leavesAt(united(all));
    leaves.insert(leaves.end(), others.begin(), others.end());
  }

  void order(std::vector<LeafTetrahedron>& tetrahedra) const
  {
    const auto treeIndicesOf = [this](const LeafTetrahedron& tetrahedron)
    {
      std::array<std::uint64_t, 4> indices{};
      std::transform(tetrahedron.corners.begin(), tetrahedron.corners.end(), indices.begin(),
        [this](std::size_t leaf) { return this->Tree.nodes[leaf].begin; });
      std::sort(indices.begin(), indices.end());
      return indices;
    };
    std::sort(tetrahedra.begin(), tetrahedra.end(),
      [&](const LeafTetrahedron& a, const LeafTetrahedron& b)
      { return treeIndicesOf(a) < treeIndicesOf(b); });
  }

  void unite(std::vector<std::size_t>& found)
  {
    found = united(this->Processes.gather(found));
    std::sort(found.begin(), found.end());
  }

  /// Each rank fits around the edges that it owns.
  std::vector<LocalFit> fitShared(const Execution& execution, ExtractionContext<TSample>& context,
    const FitRequest& request, const Edges& edges, const std::vector<Vector>& starts)
  {
    std::vector<LocalFit> fits(edges.size());
    const std::vector<std::size_t> own =
      chosenThat(execution, orderInTree(execution, this->Tree, edges),
        [&](std::size_t i)
        {
          const EdgeLeaves leaves{ edges[i].firstLeaf, edges[i].secondLeaf };
          return this->Tree.isOwn(lowerTreeIndex(this->Tree, leaves));
        });
    fitAt(execution, context, *this, request, edges, starts, own, fits);
    this->gatherFits(own, fits);
    return fits;
  }

private:
  std::size_t rankCount() const { return static_cast<std::size_t>(this->Processes.size()); }

  template <class T>
  static std::vector<T> united(const std::vector<std::vector<T>>& lists)
  {
    std::vector<T> all;
    for (const std::vector<T>& list : lists)
    {
      all.insert(all.end(), list.begin(), list.end());
    }
    return all;
  }

  /// Calls action(rank) for each other rank that has an end of an edge.
  template <class Action>
  void forOtherRanks(const CrossingEdge<TSample>& edge, const Action& action) const
  {
    for (const auto leaf : { edge.firstLeaf, edge.secondLeaf })
    {
      const Node<TSample>& node = this->Tree.nodes[leaf];
      if (!this->Tree.hasOwn(node))
      {
        action(this->ownerOf(node.begin));
      }
    }
  }

  void gatherFits(const std::vector<std::size_t>& own, std::vector<LocalFit>& fits)
  {
    ByteBuffer sent;
    for (const std::size_t edge : own)
    {
      append(sent, static_cast<std::uint64_t>(edge));
      appendFit(sent, fits[edge]);
    }
    for (const ByteBuffer& buffer : this->Processes.gather(sent))
    {
      ByteReader in(buffer);
      while (!in.isAtEnd())
      {
        const auto edge = static_cast<std::size_t>(in.read<std::uint64_t>());
        fits[edge] = readFit(in);
      }
    }
  }

  ProcessGroup& Processes;
  SampleTree<TSample>& Tree;
  const std::vector<std::uint64_t>& Begins;
  NodeExchange<TSample> Exchange;
};

} // namespace isopoint
