// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tetrahedra/SphereSearch.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Tree/NodeMarks.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Once all crossing cells are certified, finds samples on the wrong side of the surface: below the
/// isovalue among vertices that are not, or the reverse. There, a piece of the surface is missing.
/// If no searched sphere reaches a box of samples, the surface does not either, and testing one of
/// its samples tests all. In a process group, each rank checks its own samples.
template <class TSample>
class SideCheck
{
public:
  SideCheck(const Execution& execution, const SampleTree<TSample>& tree,
    const PartialTriangulation& triangulation, const NodeMarks& marks, LeafValues<TSample>& values)
    : Run(execution)
    , Tree(tree)
    , Triangulation(triangulation)
    , Marks(marks)
    , Values(values)
  {
  }

  /// @returns leaves to insert and other nodes, of few samples, to split; with repetitions
  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(nodes), plus one location per reached leaf and per maximal unreached node
  std::vector<std::size_t> find(double isovalue)
  {
    this->Isovalue = isovalue;
    const Summary root = this->collect(rootNode, false);
    this->addUnlessKnown(root, rootNode);
    constexpr std::size_t grain = 512;
    return collected<std::size_t>(this->Run, { this->Queries.size(), 8 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        std::vector<Vector> positions;
        for (std::size_t i = begin; i < end; ++i)
        {
          positions.push_back(positionOf(this->Tree.samples[this->Queries[i].sample]));
        }
        const std::vector<bool> below = this->Triangulation.areBelow(positions);
        for (std::size_t i = begin; i < end; ++i)
        {
          if (below[i - begin] != this->Queries[i].isBelow)
          {
            found.push_back(this->Queries[i].node);
          }
        }
      });
  }

private:
  struct Summary
  {
    bool isClear; // no sphere reached its samples' bounding box, and all are on one side
    bool isKnown; // one of its samples is a vertex
    bool isBelow; // the side, if clear
  };

  struct Query
  {
    std::size_t sample;
    std::size_t node; // without children, that contains the sample
    bool isBelow;
  };

  /// @param isReached whether a sphere reached the node before it was split
  Summary collect(std::size_t nodeIndex, bool isReached)
  {
    constexpr std::size_t batch = 4096;
    if (this->Visits++ % batch == 0)
    {
      throwIfAborted(this->Run);
    }
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (!this->Tree.hasOwn(node))
    {
      return { false, false, false };
    }
    isReached = isReached || this->Marks.has(nodeIndex, nodemarks::reached);
    if (!node.isSplit())
    {
      return this->collectEnd(nodeIndex, isReached);
    }
    const Summary lower = this->collect(node.lowerNode(), isReached);
    const Summary upper = this->collect(node.upperNode(), isReached);
    // The surface may pass through a child's region, but not through the box of its samples.
    const bool isMissed = this->Marks.has(node.lowerNode(), nodemarks::missed) ||
                          this->Marks.has(node.upperNode(), nodemarks::missed);
    if (lower.isClear && upper.isClear && lower.isBelow == upper.isBelow && !isMissed)
    {
      return { true, lower.isKnown || upper.isKnown, lower.isBelow };
    }
    this->addUnlessKnown(lower, node.lowerNode());
    this->addUnlessKnown(upper, node.upperNode());
    return { false, false, false };
  }

  /// Collects the samples of a node without children.
  Summary collectEnd(std::size_t nodeIndex, bool isReached)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    // Nodes with samples on both sides are split down to leaves.
    const bool isBelow = node.isLeaf ? this->Values.at(nodeIndex) < this->Isovalue
                                     : static_cast<double>(node.minimum) < this->Isovalue;
    const bool isKnown = node.isLeaf && this->Marks.has(nodeIndex, nodemarks::inserted);
    if (!isReached)
    {
      return { true, isKnown, isBelow };
    }
    if (!isKnown)
    {
      for (std::size_t i = node.begin; i < node.positionsEnd(); ++i)
      {
        this->Queries.push_back({ i, nodeIndex, isBelow });
      }
    }
    return { false, false, false };
  }

  /// Adds one sample to represent a clear node, unless one is a vertex.
  void addUnlessKnown(const Summary& summary, std::size_t nodeIndex)
  {
    if (summary.isClear && !summary.isKnown)
    {
      std::size_t end = nodeIndex;
      while (this->Tree.nodes[end].isSplit())
      {
        end = this->Tree.nodes[end].lowerNode();
      }
      this->Queries.push_back({ this->Tree.nodes[end].begin, end, summary.isBelow });
    }
  }

  const Execution& Run;
  const SampleTree<TSample>& Tree;
  const PartialTriangulation& Triangulation;
  const NodeMarks& Marks;
  LeafValues<TSample>& Values;
  double Isovalue = 0.0;
  std::size_t Visits = 0; // of nodes
  std::vector<Query> Queries;
};

} // namespace isopoint
