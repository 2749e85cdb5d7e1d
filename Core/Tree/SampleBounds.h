// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Offset.h"
#include "Core/Base/RawArray.h"
#include "Core/Base/Region.h"
#include "Core/Tree/SampleTree.h"

#include <atomic>
#include <cstddef>
#include <mutex>

namespace isopoint
{

/// The bounding box of a node's samples. O(samples), O(1) for a leaf.
template <class TSample>
Region boxOfSamples(const SampleTree<TSample>& tree, const Node<TSample>& node)
{
  Region box = emptyRegion;
  for (std::size_t i = node.begin; i < node.positionsEnd(); ++i)
  {
    const Vector position = positionOf(tree.samples[i]);
    box = united(box, { position, position });
  }
  return box;
}

/// The bounding boxes of the samples of split nodes, which can be far smaller than their regions.
/// Memory: a box per split node once compute() has run. The tree may only be split further.
template <class TSample>
class SampleBounds
{
public:
  explicit SampleBounds(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// Computes the boxes at the first call: O(samples + nodes). Thread-safe.
  /// @throws std::bad_alloc; the next call tries again
  void compute()
  {
    if (this->Tree.isPartial)
    {
      return; // computed on demand: a partial tree grows as samples are fetched
    }
    std::call_once(this->Computed,
      [this]()
      {
        this->Boxes.resize(this->Tree.usedPairs);
        bool areOfLeaves = true;
        this->boxOf(this->Tree.nodes[rootNode],
          [&](std::size_t pair, const Region& box)
          {
            this->Boxes[pair] = box;
            areOfLeaves =
              areOfLeaves && this->hasOnePosition(2 * pair) && this->hasOnePosition(2 * pair + 1);
          });
        this->AreOfLeaves.store(areOfLeaves, std::memory_order_release);
      });
  }

  /// Whether compute() has found all samples in split nodes and leaves, whose boxes need no
  /// regions.
  bool areOfLeaves() const { return this->AreOfLeaves.load(std::memory_order_acquire); }

  /// The box of a split node, if areOfLeaves().
  const Region& box(const Node<TSample>& node) const { return this->Boxes[node.childPair]; }

  /// Bounds on the offsets from a position to the samples of a leaf or split node.
  /// @param node an element of the tree's nodes, not a copy
  /// @throws MissingNode if another rank holds some of them
  OffsetBounds offsets(const Vector& from, const Node<TSample>& node) const
  {
    if (!node.isSplit())
    {
      this->require(node);
      const auto* const position = this->Tree.samples[node.begin].position;
      return offsetsToBox(from, position, position);
    }
    const auto pair = node.childPair;
    const Region box = pair < this->Boxes.size()
                         ? this->Boxes[pair]
                         : this->BoxesOnDemand.at(pair, [&]()
                             { return this->boxOf(node, [](std::size_t, const Region&) {}); });
    return offsetsToBox(from, box.lower, box.upper);
  }

private:
  /// @param note(pair, box) called for each split node with its pair of children
  template <class Note>
  Region boxOf(const Node<TSample>& node, const Note& note) const
  {
    if (!node.isSplit())
    {
      this->require(node);
      return boxOfSamples(this->Tree, node);
    }
    const Region box = united(this->boxOf(this->Tree.nodes[node.lowerNode()], note),
      this->boxOf(this->Tree.nodes[node.upperNode()], note));
    note(node.childPair, box);
    return box;
  }

  bool hasOnePosition(std::size_t nodeIndex) const
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    return node.isSplit() || node.positionsEnd() - node.begin <= 1;
  }

  void require(const Node<TSample>& node) const
  {
    const auto index = static_cast<std::size_t>(&node - this->Tree.nodes.data());
    requireSamples(this->Tree, index, []() { return everywhere; });
  }

  const SampleTree<TSample>& Tree;
  RawArray<Region> Boxes;                       // by pair of children
  mutable ConcurrentMemo<Region> BoxesOnDemand; // likewise, of other pairs
  std::once_flag Computed;
  std::atomic<bool> AreOfLeaves{ false };
};

} // namespace isopoint
