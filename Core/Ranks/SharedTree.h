// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Ranks/MedianSearch.h"
#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace isopoint
{

/// One rank's view of the tree of all ranks: the top of the canonical tree, this rank's subtrees
/// with their samples, and the other subtrees as absent nodes.
template <class TSample>
struct SharedTree
{
  SampleTree<TSample> tree;
  std::vector<std::uint64_t> begins; // of the ranks' own samples in tree order, and the end
};

/// Builds a SharedTree: its top level by level, by exact medians over all ranks; then one exchange
/// brings samples to the ranks that own their subtrees. Each rank has consecutive subtrees.
template <class TSample>
class SharedTreeBuilder
{
public:
  /// @param loaded this rank's samples, with ids of the whole cloud, in a tree of only a root
  /// @param idCount of the whole cloud
  SharedTreeBuilder(ProcessGroup& processes, SampleTree<TSample> loaded, std::uint64_t idCount)
    : Processes(processes)
    , Loaded(std::move(loaded))
    , IdCount(idCount)
  {
  }

  /// Collective. @throws std::bad_alloc, Aborted, FailedElsewhere
  SharedTree<TSample> build(const Execution& execution)
  {
    const std::uint64_t count = this->Processes.sum(this->Loaded.samples.size());
    this->Result.tree.isPartial = true;
    this->Result.tree.skipped = this->Loaded.skipped;
    if (count > 0)
    {
      this->makeSharedRoot(count);
      const int depth = topDepth(this->Processes.size());
      for (int level = 0; level < depth; ++level)
      {
        this->splitLevel(execution);
        execution.progress((level + 1.0) / depth);
      }
      this->computeRanges();
    }
    this->redistribute(count);
    return std::move(this->Result);
  }

private:
  /// Subtrees are of similar size except for coincident samples: one per rank, or a few if the
  /// number of ranks is not a power of two.
  static int topDepth(int ranks)
  {
    const int levels = levelsToHalve(static_cast<std::size_t>(ranks));
    const bool isPower = (ranks & (ranks - 1)) == 0;
    return isPower ? levels : levels + 2;
  }

  void makeSharedRoot(std::uint64_t count)
  {
    std::vector<std::uint64_t> keys(6, 0); // greatest and, inverted, least coordinates
    for (std::size_t axis = 0; axis < 3 && !this->Loaded.isEmpty(); ++axis)
    {
      keys[axis] = orderedKey(this->Loaded.region.upper[axis]);
      keys[3 + axis] = ~orderedKey(this->Loaded.region.lower[axis]);
    }
    SampleTree<TSample>& tree = this->Result.tree;
    tree.nodes.resize(2);
    tree.usedPairs = 1;
    tree.nodes[rootNode] = makeNode<TSample>(0, count);
    this->Processes.maximum(keys);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      tree.region.upper[axis] = fromOrderedKey(keys[axis]);
      tree.region.lower[axis] = fromOrderedKey(~keys[3 + axis]);
    }
    this->LevelNodes.push_back({ rootNode, tree.region, 0, this->Loaded.samples.size(), count });
  }

  /// Positions of a node's samples relative to its middle sample.
  struct Sides
  {
    std::uint64_t less = 0;       // number at lower positions, in the order of the node's axes
    std::uint64_t equalBelow = 0; // number at the same position with lower ids
    std::uint64_t greater = 0;
    std::uint64_t last = 0;     // greatest key of the lower ones on the axis, or 0
    std::uint64_t notFirst = 0; // inverted, least key of the greater ones on the axis
  };

  /// -1, 0 or 1 if a sample is below, at or above the position of a middle sample.
  static int sideOf(const TSample& sample, const MiddleSample& middle, const Vector& coordinates)
  {
    for (int i = 0; i < 3; ++i)
    {
      const auto coordinate = static_cast<double>(sample.position[(middle.axis + i) % 3]);
      const double other = coordinates[static_cast<std::size_t>(i)];
      if (coordinate != other)
      {
        return coordinate < other ? -1 : 1;
      }
    }
    return 0;
  }

  /// The coordinates of a middle sample, from its axis on.
  static Vector coordinatesOf(const MiddleSample& middle)
  {
    return { fromOrderedKey(middle.keys[0]), fromOrderedKey(middle.keys[1]),
      fromOrderedKey(middle.keys[2]) };
  }

  Sides sidesOf(const DistributedNode& node, const MiddleSample& middle) const
  {
    const Vector coordinates = coordinatesOf(middle);
    const double infinity = std::numeric_limits<double>::infinity();
    Sides sides;
    double last = -infinity;
    double first = infinity;
    for (std::size_t i = node.begin; i < node.end; ++i)
    {
      const TSample& sample = this->Loaded.samples[i];
      const auto coordinate = static_cast<double>(sample.position[middle.axis]);
      const int side = sideOf(sample, middle, coordinates);
      if (side < 0)
      {
        ++sides.less;
        last = std::max(last, coordinate);
      }
      else if (side > 0)
      {
        ++sides.greater;
        first = std::min(first, coordinate);
      }
      else
      {
        sides.equalBelow += sample.id < middle.keys[3] ? 1 : 0;
      }
    }
    sides.last = sides.less > 0 ? orderedKey(last) : 0;
    sides.notFirst = sides.greater > 0 ? ~orderedKey(first) : 0;
    return sides;
  }

  /// Combined over all ranks.
  std::vector<Sides> sidesOf(
    const std::vector<DistributedNode>& nodes, const std::vector<MiddleSample>& middles)
  {
    std::vector<std::uint64_t> sums;
    std::vector<std::uint64_t> maxima;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const Sides sides = this->sidesOf(nodes[i], middles[i]);
      sums.insert(sums.end(), { sides.less, sides.equalBelow, sides.greater });
      maxima.insert(maxima.end(), { sides.last, sides.notFirst });
    }
    this->Processes.sum(sums);
    this->Processes.maximum(maxima);
    std::vector<Sides> all(nodes.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = { sums[3 * i], sums[3 * i + 1], sums[3 * i + 2], maxima[2 * i], maxima[2 * i + 1] };
    }
    return all;
  }

  /// Splits all nodes of the current level that are not leaves.
  void splitLevel(const Execution& execution)
  {
    throwIfAborted(execution);
    std::vector<DistributedNode> nodes;
    std::copy_if(this->LevelNodes.begin(), this->LevelNodes.end(), std::back_inserter(nodes),
      [this](const DistributedNode& node)
      { return !this->Result.tree.nodes[node.nodeIndex].isLeaf; });
    if (nodes.empty())
    {
      return;
    }
    MedianSearch<TSample> search(this->Processes, this->Loaded.samples.data(), this->IdCount);
    const std::vector<MiddleSample> middles = search.find(nodes);
    const std::vector<Sides> sides = this->sidesOf(nodes, middles);
    std::vector<DistributedNode> below;
    std::size_t next = 0;
    for (const DistributedNode& node : this->LevelNodes)
    {
      if (this->Result.tree.nodes[node.nodeIndex].isLeaf)
      {
        below.push_back(node);
      }
      else
      {
        this->splitNode(node, middles[next], sides[next], below);
        ++next;
      }
    }
    this->LevelNodes.swap(below);
  }

  /// Splits a node by the definition (docs/algorithm.md, section 3).
  void splitNode(const DistributedNode& node, const MiddleSample& middle, const Sides& sides,
    std::vector<DistributedNode>& below)
  {
    SampleTree<TSample>& tree = this->Result.tree;
    const double coordinate = fromOrderedKey(middle.keys[0]);
    double last = fromOrderedKey(sides.last);
    double first = coordinate;
    std::uint64_t lowerCount = sides.less;
    bool isLower = false; // whether samples at the middle's position belong in the lower half
    if (sides.equalBelow > 0 && sides.greater > 0)
    {
      isLower = true;
      lowerCount = node.count - sides.greater;
      last = coordinate;
      first = fromOrderedKey(~sides.notFirst);
    }
    else if (sides.equalBelow > 0 && sides.less == 0)
    {
      tree.nodes[node.nodeIndex].isLeaf = true;
      below.push_back(node);
      return;
    }
    const Vector at = coordinatesOf(middle);
    TSample* const samples = this->Loaded.samples.data();
    const TSample* const cut = std::partition(samples + node.begin, samples + node.end,
      [&](const TSample& sample) { return sideOf(sample, middle, at) < (isLower ? 1 : 0); });
    const auto localMiddle = static_cast<std::size_t>(cut - samples);

    const std::size_t pair = appendPairs(tree, 1);
    Node<TSample>& parent = tree.nodes[node.nodeIndex];
    parent.plane = splittingPlaneBetween(last, first);
    parent.axis = static_cast<std::uint8_t>(middle.axis);
    parent.childPair = static_cast<typename TSample::Id>(pair);
    const std::size_t globalMiddle = parent.begin + lowerCount;
    tree.nodes[parent.lowerNode()] = makeNode<TSample>(parent.begin, globalMiddle);
    tree.nodes[parent.upperNode()] = makeNode<TSample>(globalMiddle, parent.end);
    this->SplitNodes.push_back(node.nodeIndex);
    const auto axis = static_cast<std::size_t>(middle.axis);
    Region lower = node.region;
    Region upper = node.region;
    lower.upper[axis] = parent.plane;
    upper.lower[axis] = parent.plane;
    below.push_back({ parent.lowerNode(), lower, node.begin, localMiddle, lowerCount });
    below.push_back({ parent.upperNode(), upper, localMiddle, node.end, node.count - lowerCount });
  }

  /// The value ranges of all nodes.
  void computeRanges()
  {
    using Value = typename TSample::Value;
    std::vector<std::uint64_t> keys(2 * this->LevelNodes.size(), 0);
    for (std::size_t i = 0; i < this->LevelNodes.size(); ++i)
    {
      for (std::size_t sample = this->LevelNodes[i].begin; sample < this->LevelNodes[i].end;
           ++sample)
      {
        const std::uint64_t key =
          orderedKey(static_cast<double>(this->Loaded.samples[sample].value));
        keys[2 * i] = std::max(keys[2 * i], key);
        keys[2 * i + 1] = std::max(keys[2 * i + 1], ~key);
      }
    }
    this->Processes.maximum(keys);
    SampleTree<TSample>& tree = this->Result.tree;
    for (std::size_t i = 0; i < this->LevelNodes.size(); ++i)
    {
      Node<TSample>& node = tree.nodes[this->LevelNodes[i].nodeIndex];
      node.maximum = static_cast<Value>(fromOrderedKey(keys[2 * i]));
      node.minimum = static_cast<Value>(fromOrderedKey(~keys[2 * i + 1]));
    }
    for (auto index = this->SplitNodes.rbegin(); index != this->SplitNodes.rend(); ++index)
    {
      Node<TSample>& node = tree.nodes[*index];
      uniteRanges(node, tree.nodes[node.lowerNode()], tree.nodes[node.upperNode()]);
    }
  }

  /// The owner of a subtree: the rank whose equal share of all samples contains its middle.
  std::size_t ownerOf(const DistributedNode& node, std::uint64_t all) const
  {
    const auto begin = static_cast<double>(this->Result.tree.nodes[node.nodeIndex].begin);
    const double middle =
      (begin + 0.5 * static_cast<double>(node.count)) / static_cast<double>(all);
    const auto ranks = static_cast<std::size_t>(this->Processes.size());
    return std::min(ranks - 1, static_cast<std::size_t>(middle * static_cast<double>(ranks)));
  }

  /// Sends each sample to the owner of its subtree.
  void redistribute(std::uint64_t all)
  {
    const auto ranks = static_cast<std::size_t>(this->Processes.size());
    const auto own = static_cast<std::size_t>(this->Processes.rank());
    SampleTree<TSample>& tree = this->Result.tree;
    std::vector<std::vector<std::size_t>> partsOf(ranks); // by rank, in LevelNodes
    std::vector<std::vector<std::uint64_t>> counts(ranks);
    this->Result.begins.assign(ranks + 1, 0);
    for (std::size_t i = 0; i < this->LevelNodes.size(); ++i)
    {
      const DistributedNode& node = this->LevelNodes[i];
      const std::size_t owner = this->ownerOf(node, all);
      partsOf[owner].push_back(i);
      counts[owner].push_back(node.end - node.begin);
      this->Result.begins[owner + 1] += node.count;
      tree.nodes[node.nodeIndex].isAbsent = owner != own;
    }
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      this->Result.begins[rank + 1] += this->Result.begins[rank];
    }
    tree.ownBegin = this->Result.begins[own];
    tree.ownEnd = this->Result.begins[own + 1];
    tree.samples.spread(all, tree.ownBegin, tree.ownEnd - tree.ownBegin);
    const std::vector<std::vector<std::uint64_t>> arriving = this->Processes.exchange(counts);
    std::size_t rounds = 0;
    for (const std::vector<std::size_t>& parts : partsOf)
    {
      rounds = std::max(rounds, parts.size());
    }
    // In slices, so that few samples are held twice.
    constexpr std::uint64_t fewSamples = std::uint64_t{ 1 } << 18;
    const auto slices =
      static_cast<std::size_t>(std::clamp<std::uint64_t>(all / ranks / fewSamples, 1, 16));
    for (std::size_t round = 0; round < rounds; ++round)
    {
      for (std::size_t slice = 0; slice < slices; ++slice)
      {
        this->sendParts(partsOf, arriving, round, { slice, slices });
      }
    }
    this->Loaded = SampleTree<TSample>();
    this->sortLeaves(partsOf[own]);
  }

  /// One of several slices of a list.
  struct Slice
  {
    std::size_t index;
    std::size_t count;

    std::size_t begin(std::size_t size) const { return size / this->count * this->index; }
    std::size_t end(std::size_t size) const
    {
      return this->index + 1 < this->count ? size / this->count * (this->index + 1) : size;
    }
    std::size_t length(std::size_t size) const { return this->end(size) - this->begin(size); }
  };

  /// Sends a slice of each rank's subtree number `round`, if it has one, and frees its memory.
  void sendParts(const std::vector<std::vector<std::size_t>>& partsOf,
    const std::vector<std::vector<std::uint64_t>>& arriving, std::size_t round, const Slice& slice)
  {
    const auto own = static_cast<std::size_t>(this->Processes.rank());
    SampleTree<TSample>& tree = this->Result.tree;
    std::vector<OutgoingBytes> from(partsOf.size());
    std::vector<IncomingBytes> to(partsOf.size());
    for (std::size_t rank = 0; rank < partsOf.size(); ++rank)
    {
      if (round < partsOf[rank].size())
      {
        const DistributedNode& node = this->LevelNodes[partsOf[rank][round]];
        const std::size_t count = node.end - node.begin;
        from[rank] = { this->Loaded.samples.data() + node.begin + slice.begin(count),
          slice.length(count) * sizeof(TSample) };
      }
    }
    if (round < partsOf[own].size())
    {
      std::size_t next = tree.nodes[this->LevelNodes[partsOf[own][round]].nodeIndex].begin;
      for (std::size_t rank = 0; rank < partsOf.size(); ++rank)
      {
        const std::size_t count = arriving[rank][round];
        to[rank] = { tree.samples.data() + next + slice.begin(count),
          slice.length(count) * sizeof(TSample) };
        next += count;
      }
    }
    this->Processes.exchange(from, to);
    for (std::size_t rank = 0; rank < partsOf.size() && slice.count > 1; ++rank)
    {
      if (round < partsOf[rank].size())
      {
        const DistributedNode& node = this->LevelNodes[partsOf[rank][round]];
        const std::size_t count = node.end - node.begin;
        this->Loaded.samples.discard(
          node.begin + slice.begin(count), node.begin + slice.end(count));
      }
    }
  }

  /// Sorts coincident samples by id.
  void sortLeaves(const std::vector<std::size_t>& parts)
  {
    SampleTree<TSample>& tree = this->Result.tree;
    for (const std::size_t part : parts)
    {
      const Node<TSample>& node = tree.nodes[this->LevelNodes[part].nodeIndex];
      if (node.isLeaf)
      {
        std::sort(tree.samples.data() + node.begin, tree.samples.data() + node.end,
          [](const TSample& a, const TSample& b) { return a.id < b.id; });
      }
    }
  }

  ProcessGroup& Processes;
  SampleTree<TSample> Loaded;
  std::uint64_t IdCount;
  SharedTree<TSample> Result;
  std::vector<DistributedNode> LevelNodes; // nodes of the current level, and leaves above it
  std::vector<std::size_t> SplitNodes;     // nodes, parents first
};

} // namespace isopoint
