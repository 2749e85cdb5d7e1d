// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Region.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/TreeletSplitting.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Splits nodes further: small ones down to leaves, others by one treelet. The result is part of
/// the canonical tree, whatever was split before.
/// @param nodes node indices in any order, with repetitions; split nodes and leaves are skipped
/// @throws std::bad_alloc, Aborted, or TreeTooLarge (see NarrowBand)
template <class TSample>
void splitFurther(
  const Execution& execution, SampleTree<TSample>& tree, std::vector<std::size_t> nodes)
{
  struct Task
  {
    std::size_t node;
    std::size_t firstPair;
    int levels;
    Region region;
  };
  constexpr std::size_t small = 512;
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
      const int levels = std::min(maximumDepth - path.depth,
        node.count() <= small ? levelsToHalve(small) + 1 : treeletLevels);
      if (levels == 0)
      {
        throwTooDeep();
      }
      tasks.push_back({ nodes[i], pairs, levels, path.region });
      pairs += maximumTreeletPairs(node.count(), levels);
    });
  const std::size_t firstPair = appendPairs(tree, pairs);
  forBatches(execution, tasks.size(), 512, 4,
    [&](std::size_t begin, std::size_t end)
    {
      TreeletSplitter<TSample> splitter(tree, 0);
      for (std::size_t i = begin; i < end; ++i)
      {
        splitter.moveTo(firstPair + tasks[i].firstPair);
        splitter.split(tree.nodes[tasks[i].node], tasks[i].region, tasks[i].levels);
      }
    });
}

/// Splits unsplit nodes until none is found.
/// @param addUnsplit(item, nodes) appends unsplit nodes at an item below count; from any thread
/// @param batchDone called while items are examined; repeated after nodes were split
/// @throws as splitFurther()
template <class TSample, class AddUnsplit>
void splitWhileUnsplit(
  const Execution& execution, SampleTree<TSample>& tree, std::size_t count,
  const AddUnsplit& addUnsplit, const BatchDone& batchDone = [](double) {})
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
