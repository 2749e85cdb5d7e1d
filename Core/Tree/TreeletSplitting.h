// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/Splitting.h"

#include <algorithm>
#include <cstddef>
#include <mutex>

namespace isopoint
{

/// Levels of a treelet, the unit by which the tree grows [KA13]: the narrow band decides after each
/// treelet which nodes to split next, and a treelet is built while its samples are in cache.
constexpr int treeletLevels = 3;

/// The bottom of treelets below nodes at a depth. Treelets are aligned to the bottom of a tree
/// without coincident samples, so that the last ones, by far the most, have full depth.
inline int treeletBottom(int depth, std::size_t sampleCount)
{
  const int remaining = levelsToHalve(sampleCount) - depth;
  return depth + (remaining > treeletLevels ? (remaining - 1) % treeletLevels + 1 : treeletLevels);
}

/// The greatest number of pairs in a treelet below a node of `sampleCount` samples.
inline std::size_t maximumTreeletPairs(std::size_t sampleCount, int levels)
{
  return std::min<std::size_t>(sampleCount - 1, (std::size_t{ 1 } << levels) - 1);
}

/// The most samples of a bucket.
constexpr std::size_t bucketSize = 8;

/// Marks a node as a bucket if it is small and all its samples are at different positions.
/// @returns whether it is one
template <class TSample>
bool markBucket(SampleTree<TSample>& tree, Node<TSample>& node)
{
  if (node.count() > bucketSize)
  {
    return false;
  }
  const TSample* const samples = tree.samples.data();
  for (std::size_t i = node.begin; i < node.end; ++i)
  {
    const auto isAtSame = [&](const TSample& other) { return haveOnePosition(samples[i], other); };
    if (std::any_of(samples + i + 1, samples + node.end, isAtSame))
    {
      return false;
    }
  }
  node.isBucket = true;
  return true;
}

/// Splits nodes by the definition of the canonical tree (docs/algorithm.md, section 3; [RL06]
/// section 4). The top node becomes a parent last, so an exception leaves it unsplit.
template <class TSample>
class TreeletSplitter
{
public:
  /// @param firstPair first of the maximumTreeletPairs() pairs reserved for the treelet
  TreeletSplitter(SampleTree<TSample>& tree, std::size_t firstPair)
    : Tree(tree)
    , NextPair(firstPair)
  {
  }

  /// Sets the first pair of the next treelet.
  void moveTo(std::size_t firstPair) { this->NextPair = firstPair; }

  /// Splits a node `levels` levels deep in the calling thread. New nodes get value ranges.
  void split(Node<TSample>& node, const Region& region, int levels)
  {
    const auto halveAlone = [this](TSample* samples, std::size_t count, int axis)
    { return halve(samples, count, axis, this->Scratch); };
    const auto rangeAlone = [this](Node<TSample>& bottom)
    { computeRange(bottom, this->Tree.samples.data()); };
    this->split(node, region, levels, halveAlone, rangeAlone);
  }

  /// Splits a treelet, with all threads on each node.
  void splitTogether(
    const Execution& execution, Node<TSample>& node, const Region& region, int levels)
  {
    const double work = static_cast<double>(node.count()) * levels;
    double done = 0.0;
    const auto halveAll = [&](TSample* samples, std::size_t count, int axis)
    {
      throwIfAborted(execution);
      execution.progress(done / work);
      done += static_cast<double>(count);
      return halveTogether(execution, samples, count, axis);
    };
    const auto rangeAll = [this, &execution](Node<TSample>& bottom)
    { this->computeRangeTogether(execution, bottom); };
    this->split(node, region, levels, halveAll, rangeAll);
  }

private:
  template <class Halving, class Ranging>
  void split(Node<TSample>& node, const Region& region, int levels, const Halving& halving,
    const Ranging& ranging)
  {
    if (levels == 0 || node.isLeaf)
    {
      ranging(node);
      return;
    }
    TSample* const samples = this->Tree.samples.data() + node.begin;
    const int axis = region.longestSide();
    const std::optional<Halves> halves = halving(samples, node.count(), axis);
    if (!halves)
    {
      std::sort(samples, samples + node.count(),
        [](const TSample& a, const TSample& b) { return a.id < b.id; });
      ranging(node);
      node.isLeaf = true;
      return;
    }
    const std::size_t pair = this->NextPair++;
    Node<TSample>& lower = this->Tree.nodes[2 * pair];
    Node<TSample>& upper = this->Tree.nodes[2 * pair + 1];
    const std::size_t middle = node.begin + halves->lowerCount;
    lower = makeNode<TSample>(node.begin, middle);
    upper = makeNode<TSample>(middle, node.end);
    Region half = region;
    half.upper[axis] = halves->plane;
    this->split(lower, half, levels - 1, halving, ranging);
    half.upper[axis] = region.upper[axis];
    half.lower[axis] = halves->plane;
    this->split(upper, half, levels - 1, halving, ranging);
    uniteRanges(node, lower, upper);
    node.plane = halves->plane;
    node.axis = static_cast<std::uint8_t>(axis);
    node.childPair = static_cast<typename TSample::Id>(pair);
    markBucket(this->Tree, node);
  }

  void computeRangeTogether(const Execution& execution, Node<TSample>& node)
  {
    std::mutex mutex;
    const TSample* const samples = this->Tree.samples.data();
    node.minimum = node.maximum = samples[node.begin].value;
    forRanges(execution, node.count(), node.count() / (4 * execution.threads) + 1,
      [&](std::size_t begin, std::size_t end)
      {
        Node<TSample> part = makeNode<TSample>(node.begin + begin, node.begin + end);
        computeRange(part, samples);
        const std::lock_guard<std::mutex> lock(mutex);
        uniteRanges(node, node, part);
      });
  }

  SampleTree<TSample>& Tree;
  std::size_t NextPair;
  HalvingScratch<TSample> Scratch;
};

} // namespace isopoint
