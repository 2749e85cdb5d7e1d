// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Offset.h"
#include "Core/Base/RawArray.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>

namespace isopoint
{

/// The bounding box of samples.
template <class TSample>
struct SampleBox
{
  typename TSample::Coordinate lower[3];
  typename TSample::Coordinate upper[3];
};

template <class TSample>
SampleBox<TSample> united(const SampleBox<TSample>& a, const SampleBox<TSample>& b)
{
  SampleBox<TSample> box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    box.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
  }
  return box;
}

/// O(samples of the node), O(1) for a leaf.
template <class TSample>
SampleBox<TSample> boxOfSamples(const SampleTree<TSample>& tree, const Node<TSample>& node)
{
  const auto boxOf = [](const TSample& sample)
  {
    SampleBox<TSample> box;
    std::copy_n(sample.position, 3, box.lower);
    std::copy_n(sample.position, 3, box.upper);
    return box;
  };
  SampleBox<TSample> box = boxOf(tree.samples[node.begin]);
  for (std::size_t i = node.begin; i < node.positionsEnd(); ++i)
  {
    box = united(box, boxOf(tree.samples[i]));
  }
  return box;
}

/// The bounding boxes of the samples of split nodes, which can be far smaller than their regions.
/// Memory: six coordinates per split node once compute() has run. The tree must not change
/// meanwhile, except that a partial tree may be split further.
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
        this->boxOf(this->Tree.nodes[SampleTree<TSample>::rootNode],
          [this](std::size_t pair, const Box& box) { this->Boxes[pair] = box; });
      });
  }

  /// Bounds on the offsets from a position to the samples of a leaf or split node.
  /// @throws MissingNode if another rank holds some of them
  OffsetBounds offsets(const Vector& from, const Node<TSample>& node) const
  {
    if (!node.isSplit())
    {
      this->require(node);
      const auto* const position = this->Tree.samples[node.begin].position;
      return offsetsToBox(from, position, position);
    }
    const auto pair = static_cast<std::size_t>(node.childPair);
    const Box box = this->Tree.isPartial
                      ? this->BoxesOnDemand.at(
                          pair, [&]() { return this->boxOf(node, [](std::size_t, const Box&) {}); })
                      : this->Boxes[pair];
    return offsetsToBox(from, box.lower, box.upper);
  }

private:
  using Box = SampleBox<TSample>;

  /// @param note(pair, box) called for each split node with its pair of children
  template <class Note>
  Box boxOf(const Node<TSample>& node, const Note& note) const
  {
    if (!node.isSplit())
    {
      this->require(node);
      return boxOfSamples(this->Tree, node);
    }
    const Box box = united(this->boxOf(this->Tree.nodes[node.lowerNode()], note),
      this->boxOf(this->Tree.nodes[node.upperNode()], note));
    note(static_cast<std::size_t>(node.childPair), box);
    return box;
  }

  void require(const Node<TSample>& node) const
  {
    const auto everywhere = []()
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return Region{ { -infinity, -infinity, -infinity }, { infinity, infinity, infinity } };
    };
    requireSamples(
      this->Tree, static_cast<std::size_t>(&node - this->Tree.nodes.data()), everywhere);
  }

  const SampleTree<TSample>& Tree;
  RawArray<Box> Boxes;                       // by pair of children
  mutable ConcurrentMemo<Box> BoxesOnDemand; // likewise, of a partial tree
  std::once_flag Computed;
};

} // namespace isopoint
