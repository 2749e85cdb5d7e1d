// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/NodeMarks.h"
#include "Core/Tree/TreeRefinement.h"
#include "Core/Tree/TreeletSplitting.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace isopoint
{

/// A node in the band. It is crossing if the surface may pass between it and nodes that touch it.
struct BandNode
{
  BinaryIndex index;
  std::size_t nodeIndex;
  bool isCrossing;
};

/// Whether the node, or the node and one that touches it, have samples on both sides of the
/// isovalue: then the surface may pass here.
template <class TSample>
bool isCrossing(const SampleTree<TSample>& tree, std::size_t nodeIndex,
  const TouchingRoots& surroundings, int nodeDepth, double isovalue)
{
  const Node<TSample>& node = tree.nodes[nodeIndex];
  const bool hasBelow = node.minimum < isovalue;
  const bool hasAbove = node.maximum >= isovalue;
  return (hasBelow && hasAbove) ||
         touchesOtherSide(tree, surroundings, nodeDepth, isovalue, hasBelow);
}

/// Refines a tree around one isosurface, treelet by treelet: only nodes that may contain a piece of
/// the surface, and nodes that touch them, are split (docs/algorithm.md, section 9).
template <class TSample>
class NarrowBand
{
public:
  /// @param execution its progress grows with the depth
  NarrowBand(SampleTree<TSample>& tree, double isovalue, const Execution& execution)
    : Tree(tree)
    , Isovalue(isovalue)
    , Run(execution)
    , ListBudget(tree.ownCount())
  {
  }

  /// Collective. Nodes without samples of this rank are not split; their value ranges are fetched.
  /// @param ranks SingleRank or SharedRanks
  /// @returns nodes whose subtrees contain all (of this rank's) leaves with crossing edges; these
  /// subtrees, and everything that touches their leaves, are split down to leaves
  /// @throws Aborted, std::bad_alloc; the tree can be refined again
  /// @throws TreeTooLarge if the tree would exceed maximumDepth, which takes over 2^31 samples
  /// in nested groups of coincident ones, or have more nodes than ids can number
  template <class TRanks>
  std::vector<BinaryIndex> refine(TRanks& ranks)
  {
    std::vector<BandNode> front;
    const Node<TSample> root = this->Tree.nodes[rootNode];
    if (root.minimum < this->Isovalue && root.maximum >= this->Isovalue && this->Tree.hasOwn(root))
    {
      front.push_back({ rootIndex, rootNode, true });
    }
    bool isDone = front.empty();
    for (int depth = 0; ranks.isAny(!isDone);)
    {
      const int bottom = treeletBottom(depth, root.count());
      const auto shareAt = [&](double level)
      { return std::min(1.0, level / levelsToHalve(root.count())); };
      const double middle = 0.5 * (depth + bottom);
      if (!isDone)
      {
        this->splitFront(partOf(this->Run, shareAt(depth), shareAt(middle)), front, bottom);
        isDone = this->finishIfFew(front, depth, bottom);
      }
      this->mark(partOf(this->Run, shareAt(middle), shareAt(bottom)), ranks,
        isDone ? std::vector<BandNode>() : front, bottom);
      if (!isDone)
      {
        front = this->neededBelow(front, bottom);
        isDone = front.empty();
      }
      depth = bottom;
      throwIfAborted(this->Run);
    }
    std::vector<BinaryIndex> crossing;
    for (const BandNode& node : front)
    {
      if (node.isCrossing)
      {
        crossing.push_back(node.index);
      }
    }
    return crossing;
  }

private:
  using NodeType = Node<TSample>;

  /// Splits the front down to leaves if few samples remain: faster than deciding which are needed.
  /// @returns whether it did
  bool finishIfFew(const std::vector<BandNode>& front, int depth, int bottom)
  {
    const std::size_t few = front.size() / 4;
    const std::size_t unfinished = this->unfinishedSamples(front, bottom - depth, few);
    if (unfinished > few)
    {
      return false;
    }
    if (unfinished > 0)
    {
      std::vector<std::size_t> tops;
      tops.reserve(front.size());
      for (const BandNode& node : front)
      {
        tops.push_back(node.nodeIndex);
      }
      splitCompletely(this->Run, this->Tree, tops);
    }
    return true;
  }

  static constexpr std::size_t searchGrain = 64;

  /// Nodes per thread between checks for an abort.
  static constexpr std::size_t searchBatch = 64 * searchGrain;

  /// A treelet to build below a node.
  struct TreeletTask
  {
    BandNode node;
    std::size_t firstPair;
    int levels;
  };

  void splitFront(const Execution& execution, const std::vector<BandNode>& front, int bottom)
  {
    if (this->Tree.isPartial)
    {
      this->splitNodes(execution, this->unsplitBelow(front, bottom), bottom);
    }
    else
    {
      this->splitNodes(execution, front, bottom);
    }
  }

  /// The unsplit nodes from a front down to a depth: requests of other ranks may have split some
  /// partly. Nodes without samples of this rank are skipped.
  std::vector<BandNode> unsplitBelow(const std::vector<BandNode>& front, int depth)
  {
    return this->collectBelow(front, depth - 1,
      [this](const Path& below, std::vector<BandNode>& unsplit)
      {
        const NodeType& node = this->Tree.nodes[below.nodeIndex()];
        if (!node.isSplit() && !node.isLeaf)
        {
          unsplit.push_back({ below.index, below.nodeIndex(), true });
        }
      });
  }

  void splitNodes(const Execution& execution, const std::vector<BandNode>& front, int bottom)
  {
    if (front.empty())
    {
      return;
    }
    if (bottom > maximumDepth)
    {
      throwTooDeep();
    }
    // All threads split each node together while there are too few nodes for all threads.
    constexpr std::size_t togetherCount = std::size_t{ 1 } << 16;
    const std::size_t fewNodes = 4 * this->Run.threads;
    const std::size_t batchSamples = (std::size_t{ 1 } << 17) * this->Run.threads;

    const auto shareAt = [&front](std::size_t node)
    { return static_cast<double>(node) / static_cast<double>(front.size()); };
    std::size_t begin = 0;
    while (begin < front.size())
    {
      const double share = shareAt(begin);
      std::vector<TreeletTask> batch;
      std::size_t pairs = 0;
      std::size_t samples = 0;
      const auto isFull = [&]()
      { return samples >= (batch.size() < fewNodes ? 8 : 1) * batchSamples; };
      for (; begin < front.size() && !isFull(); ++begin)
      {
        const NodeType& node = this->Tree.nodes[front[begin].nodeIndex];
        if (node.isSplit() || node.isLeaf)
        {
          continue;
        }
        const int levels = bottom - depthOf(front[begin].index);
        batch.push_back({ front[begin], pairs, levels });
        pairs += maximumTreeletPairs(node.count(), levels);
        samples += node.count();
      }
      const std::size_t firstPair = appendPairs(this->Tree, pairs);
      for (TreeletTask& task : batch)
      {
        task.firstPair += firstPair;
      }
      this->splitBatch(partOf(execution, share, shareAt(begin)), batch,
        batch.size() < fewNodes ? togetherCount : samples + 1);
      throwIfAborted(this->Run);
    }
  }

  void splitBatch(
    const Execution& execution, const std::vector<TreeletTask>& batch, std::size_t togetherCount)
  {
    const auto shareAt = [&batch](std::size_t task)
    { return static_cast<double>(task) / static_cast<double>(batch.size()); };
    std::vector<TreeletTask> alone;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const TreeletTask& task = batch[i];
      NodeType& node = this->Tree.nodes[task.node.nodeIndex];
      if (node.count() < togetherCount)
      {
        alone.push_back(task);
        continue;
      }
      TreeletSplitter<TSample> splitter(this->Tree, task.firstPair);
      splitter.splitTogether(partOf(execution, shareAt(i), shareAt(i + 1)), node,
        pathTo(this->Tree, task.node.index).region, task.levels);
    }
    const std::size_t grain = std::min<std::size_t>(64, alone.size() / (8 * this->Run.threads) + 1);
    forRanges(this->Run, alone.size(), grain,
      [&](std::size_t begin, std::size_t end)
      {
        TreeletSplitter<TSample> splitter(this->Tree, 0);
        Path path = pathToRoot(this->Tree);
        for (std::size_t i = begin; i < end; ++i)
        {
          moveTo(this->Tree, path, alone[i].node.index);
          splitter.moveTo(alone[i].firstPair);
          splitter.split(this->Tree.nodes[alone[i].node.nodeIndex], path.region, alone[i].levels);
        }
      });
    execution.progress(1.0);
  }

  /// Samples in nodes `levels` levels below the front that are not leaves; counts up to a limit.
  std::size_t unfinishedSamples(
    const std::vector<BandNode>& front, int levels, std::size_t limit) const
  {
    std::atomic<std::size_t> samples{ 0 };
    forBatches(this->Run, front.size(), searchBatch, searchGrain,
      [&](std::size_t begin, std::size_t end)
      {
        std::size_t found = 0;
        for (std::size_t i = begin; i < end && samples + found <= limit; ++i)
        {
          found += this->unfinishedSamples(this->Tree.nodes[front[i].nodeIndex], levels);
        }
        samples += found;
      });
    return samples;
  }

  std::size_t unfinishedSamples(const NodeType& node, int levels) const
  {
    if (!node.isSplit() || levels == 0)
    {
      return node.isLeaf || !this->Tree.hasOwn(node) ? 0 : node.count();
    }
    return this->unfinishedSamples(this->Tree.nodes[node.lowerNode()], levels - 1) +
           this->unfinishedSamples(this->Tree.nodes[node.upperNode()], levels - 1);
  }

  /// Marks the crossing nodes of a depth and all that touch one. Only children of crossing nodes
  /// can be crossing. A node with neighbors on another rank is tried again once those are fetched.
  template <class TRanks>
  void mark(const Execution& execution, TRanks& ranks, std::vector<BandNode> front, int depth)
  {
    this->Marks = NodeMarks();
    std::vector<MissingNode> missing;
    do
    {
      this->Marks.grow(this->Tree.nodes.size());
      this->Deferred.clear();
      this->markBelowFront(execution, front, depth);
      front = this->Deferred;
      missing.swap(this->Missing);
      this->Missing.clear();
    } while (ranks.fetchNodes(missing, depth));
  }

  void markBelowFront(const Execution& execution, const std::vector<BandNode>& front, int depth)
  {
    forBatches(
      execution, front.size(), searchBatch, searchGrain,
      [&](std::size_t begin, std::size_t end)
      {
        Path path = pathToRoot(this->Tree);
        for (std::size_t i = begin; i < end; ++i)
        {
          if (!front[i].isCrossing)
          {
            continue;
          }
          moveTo(this->Tree, path, front[i].index);
          forEachBelow(
            this->Tree, path, depth, [&](const Path& below) { this->markAt(below, depth); });
        }
      },
      execution.progress);
  }

  /// Marks a node, if it is crossing and this rank's, and the nodes that touch it.
  void markAt(const Path& path, int depth)
  {
    if (!this->Tree.hasOwn(this->Tree.nodes[path.nodeIndex()]))
    {
      return;
    }
    const TouchingRoots surroundings(path);
    try
    {
      if (isCrossing(this->Tree, path.nodeIndex(), surroundings, depth, this->Isovalue))
      {
        this->markAround(path.nodeIndex(), surroundings, depth);
      }
    }
    catch (const MissingNode& missing)
    {
      const std::lock_guard<std::mutex> lock(this->DeferredMutex);
      this->Missing.push_back(missing);
      this->Deferred.push_back({ path.index, path.nodeIndex(), true });
    }
  }

  void markAround(std::size_t crossing, const TouchingRoots& surroundings, int depth)
  {
    this->Marks.set(crossing, needed | crossed);
    if (this->ListBudget.isSpent())
    {
      for (const FoundNode& root : surroundings)
      {
        this->markBelow(root, depth, surroundings.region);
      }
      return;
    }
    std::size_t count = 0;
    visitTouching(this->Tree, surroundings, depth,
      [this, &count](std::size_t nodeIndex)
      {
        this->Marks.set(nodeIndex, needed);
        ++count;
        return false;
      });
    this->ListBudget.spend(count);
  }

  /// Marks the nodes of a depth in a subtree that touch the region. A parent is marked once all
  /// nodes below it are, so that later searches stop there: crossing nodes share many neighbors.
  /// @returns whether all are marked
  bool markBelow(FoundNode top, int depth, const Region& region)
  {
    if (this->Marks.has(top.nodeIndex, needed))
    {
      return true;
    }
    const NodeType& node = this->Tree.nodes[top.nodeIndex];
    bool areAll = true;
    if (top.depth < depth && node.isSplit())
    {
      const FoundNode lower{ node.lowerNode(), top.depth + 1 };
      const FoundNode upper{ node.upperNode(), top.depth + 1 };
      const auto areAllIn = [&](const FoundNode& child, bool touches)
      {
        return touches ? this->markBelow(child, depth, region)
                       : this->Marks.has(child.nodeIndex, needed);
      };
      areAll = areAllIn(lower, node.plane >= region.lower[node.axis]);
      areAll = areAllIn(upper, node.plane <= region.upper[node.axis]) && areAll;
    }
    if (areAll)
    {
      this->Marks.set(top.nodeIndex, needed);
    }
    return areAll;
  }

  std::vector<BandNode> neededBelow(const std::vector<BandNode>& front, int depth)
  {
    return this->collectBelow(front, depth,
      [this](const Path& below, std::vector<BandNode>& found)
      {
        const std::size_t node = below.nodeIndex();
        if (this->Marks.has(node, needed))
        {
          found.push_back({ below.index, node, this->Marks.has(node, crossed) });
        }
      });
  }

  /// @param collect(path, list) may add a node of the depth, or an unsplit one above it; called for
  /// nodes with samples of this rank
  template <class Collect>
  std::vector<BandNode> collectBelow(
    const std::vector<BandNode>& front, int depth, const Collect& collect)
  {
    return collected<BandNode>(this->Run, { front.size(), searchBatch, searchGrain },
      [&](std::size_t begin, std::size_t end, std::vector<BandNode>& found)
      {
        Path path = pathToRoot(this->Tree);
        for (std::size_t i = begin; i < end; ++i)
        {
          moveTo(this->Tree, path, front[i].index);
          forEachBelow(this->Tree, path, depth,
            [&](const Path& below)
            {
              if (this->Tree.hasOwn(this->Tree.nodes[below.nodeIndex()]))
              {
                collect(below, found);
              }
            });
        }
      });
  }

  static constexpr std::uint8_t needed = 1;
  static constexpr std::uint8_t crossed = 2;

  SampleTree<TSample>& Tree;
  const double Isovalue;
  const Execution& Run;
  NeighborListBudget ListBudget;
  NodeMarks Marks; // of nodes down to the current depth
  std::mutex DeferredMutex;
  std::vector<BandNode> Deferred;   // nodes that wait for missing ones
  std::vector<MissingNode> Missing; // to fetch
};

} // namespace isopoint
