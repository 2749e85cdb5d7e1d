// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Region.h"
#include "Core/Base/Sorting.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/TreeletSplitting.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// Splits nodes. The result is part of the canonical tree, whatever was split before.
/// @param nodes node indices in any order, with repetitions; split nodes and leaves are skipped
/// @param levelsOf(node) how many levels to split a node, at most
/// @param split(nodeIndex) called after a node was split; from any thread
/// @throws std::bad_alloc, Aborted, or TreeTooLarge (see NarrowBand)
template <class TSample, class LevelsOf, class Split>
void splitNodes(const Execution& execution, SampleTree<TSample>& tree,
  std::vector<std::size_t> nodes, const LevelsOf& levelsOf, const Split& split)
{
  struct Task
  {
    std::size_t node;
    std::size_t firstPair;
    int levels;
    Region region;
  };
  nodes = sortedUnique(execution, nodes, tree.nodes.size());
  std::vector<Task> tasks;
  std::size_t pairs = 0;
  forEachInOrder(execution, nodes.size(),
    [&](std::size_t i)
    {
      const Node<TSample>& node = tree.nodes[nodes[i]];
      if (node.isSplit() || node.isLeaf)
      {
        return;
      }
      const Path path = pathToNode(tree, nodes[i]);
      const int levels = std::min(maximumDepth - path.depth, levelsOf(node));
      if (levels == 0)
      {
        throwTooDeep();
      }
      tasks.push_back({ nodes[i], pairs, levels, path.region });
      pairs += maximumTreeletPairs(node.count(), levels);
    });
  const std::size_t firstPair = appendPairs(tree, pairs);
  // Few large nodes, such as the root, are split by all threads, one after the other.
  constexpr std::size_t large = std::size_t{ 1 } << 18;
  const auto isLarge = [&](const Task& task)
  { return execution.threads > 1 && tree.nodes[task.node].count() >= large; };
  const auto firstLarge =
    std::partition(tasks.begin(), tasks.end(), [&](const Task& task) { return !isLarge(task); });
  std::for_each(firstLarge, tasks.end(),
    [&](const Task& task)
    {
      TreeletSplitter<TSample> splitter(tree, firstPair + task.firstPair);
      splitter.splitTogether(
        partOf(execution, 0.0, 0.0), tree.nodes[task.node], task.region, task.levels);
      split(task.node);
    });
  tasks.erase(firstLarge, tasks.end());
  forBatches(execution, tasks.size(), 512, 4,
    [&](std::size_t begin, std::size_t end)
    {
      TreeletSplitter<TSample> splitter(tree, 0);
      for (std::size_t i = begin; i < end; ++i)
      {
        splitter.moveTo(firstPair + tasks[i].firstPair);
        splitter.split(tree.nodes[tasks[i].node], tasks[i].region, tasks[i].levels);
        split(tasks[i].node);
      }
    });
}

/// The most samples of a node that is split down to its end at once.
constexpr std::size_t smallNode = 512;

/// Splits nodes further: small ones down to leaves, others by one treelet. See splitNodes().
template <class TSample>
void splitFurther(
  const Execution& execution, SampleTree<TSample>& tree, std::vector<std::size_t> nodes)
{
  splitNodes(
    execution, tree, std::move(nodes),
    [](const Node<TSample>& node)
    { return node.count() <= smallNode ? levelsToHalve(smallNode) + 1 : treeletLevels; },
    [](std::size_t) {});
}

/// Marks the buckets among the unsplit nodes at and below a node.
template <class TSample>
void markBuckets(SampleTree<TSample>& tree, std::size_t nodeIndex)
{
  Node<TSample>& node = tree.nodes[nodeIndex];
  if (!node.isSplit())
  {
    markBucket(tree, node);
    return;
  }
  markBuckets(tree, node.lowerNode());
  markBuckets(tree, node.upperNode());
}

/// Splits nodes like splitFurther(), but only down to buckets or leaves: for searches that look at
/// all samples of a bucket.
template <class TSample>
void splitToBuckets(
  const Execution& execution, SampleTree<TSample>& tree, std::vector<std::size_t> nodes)
{
  keepUnique(nodes);
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                [&](std::size_t node) { return markBucket(tree, tree.nodes[node]); }),
    nodes.end());
  splitNodes(
    execution, tree, std::move(nodes),
    [](const Node<TSample>& node)
    {
      if (node.count() > smallNode)
      {
        return treeletLevels;
      }
      return node.count() > bucketSize ? levelsToHalve((node.count() + bucketSize - 1) / bucketSize)
                                       : levelsToHalve(node.count()) + 1;
    },
    [&tree](std::size_t node) { markBuckets(tree, node); });
}

/// Splits unsplit nodes until none is found.
/// @param addUnsplit(item, nodes) appends unsplit nodes at an item below count; from any thread
/// @param batchDone called while items are examined; repeated after nodes were split
/// @throws as splitFurther()
template <class TSample, class AddUnsplit>
void splitWhileUnsplit(const Execution& execution, SampleTree<TSample>& tree, std::size_t count,
  const AddUnsplit& addUnsplit, const BatchDone& batchDone = ignoreShare)
{
  std::vector<std::size_t> unsplit;
  do
  {
    splitFurther(execution, tree, unsplit);
    constexpr std::size_t grain = 64;
    unsplit = collected<std::size_t>(
      execution, { count, 16 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          addUnsplit(i, found);
        }
      },
      batchDone);
  } while (!unsplit.empty());
}

/// Splits the subtrees below `tops` down to leaves, where this rank owns samples.
/// @throws as splitFurther()
template <class TSample>
void splitCompletely(
  const Execution& execution, SampleTree<TSample>& tree, const std::vector<std::size_t>& tops)
{
  splitWhileUnsplit(execution, tree, tops.size(),
    [&](std::size_t i, std::vector<std::size_t>& unsplit)
    {
      Path path = pathToNode(tree, tops[i]);
      forEachBelow(tree, path, maximumDepth,
        [&](const Path& below)
        {
          const Node<TSample>& node = tree.nodes[below.nodeIndex()];
          if (!node.isLeaf && tree.hasOwn(node))
          {
            unsplit.push_back(below.nodeIndex());
          }
        });
    });
}

} // namespace isopoint
