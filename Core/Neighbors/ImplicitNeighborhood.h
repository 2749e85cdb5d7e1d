// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tree/SampleBounds.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// Searches the neighborhood of a leaf by branch and bound, without listing it: the bounding boxes
/// of nodes' samples bound the results.
/// For n neighbors, as of samples on two skew lines, a search takes about O(log n). Memory is kept
/// between leaves. For one thread.
template <class TSample>
class ImplicitNeighborhood
{
public:
  ImplicitNeighborhood(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds)
    : Tree(tree)
    , Bounds(bounds)
    , CanSearch(offsetsToBox(tree.region.lower, tree.region.lower, tree.region.upper)
                  .greatestSquaredLength < std::numeric_limits<double>::max() / 16.0)
  {
  }

  /// Whether a search is possible: squared offsets between samples do not overflow.
  bool canSearch() const { return this->CanSearch; }

  /// Selects the neighborhood of a leaf. The tree must be refined around it.
  /// @throws std::bad_alloc
  void moveTo(const Path& leaf)
  {
    this->Bounds.compute();
    this->Region = leaf.region;
    this->Center = positionOf(this->Tree.sampleOf(leaf.nodeIndex()));
    this->Tops.clear();
    for (const FoundNode& root : TouchingRoots(leaf))
    {
      this->Tops.push_back(root.nodeIndex);
    }
  }

  /// Visits the neighbors that survive the angle criterion, in any order. Skips subtrees that one
  /// known neighbor drops: one near the leaf, or an earlier candidate. Each remaining candidate
  /// takes a search for any neighbor that drops it.
  /// @param enter(node) whether the node or its descendants are of interest
  /// @param isWanted(nodeIndex) whether a leaf is of interest
  /// @param visit(nodeIndex) called for each leaf of interest that survives
  template <class Filter, class Wanted, class Visitor>
  void forEachSurvivor(const AngleCriterion& criterion, const Filter& enter, const Wanted& isWanted,
    const Visitor& visit)
  {
    this->Droppers.clear();
    this->Queue.clear();
    this->addNearDroppers();
    const auto add = [&](std::size_t nodeIndex)
    {
      const Node<TSample>& node = this->Tree.nodes[nodeIndex];
      if (enter(node))
      {
        const OffsetBounds offsets = this->Bounds.offsets(this->Center, node);
        if (!this->areDropped(criterion, offsets, 0))
        {
          this->push({ offsets.minSquaredLength, nodeIndex, this->Droppers.size() });
        }
      }
    };
    std::for_each(this->Tops.begin(), this->Tops.end(), add);
    while (!this->Queue.empty())
    {
      const Found found = this->pop();
      const Node<TSample>& node = this->Tree.nodes[found.nodeIndex];
      if (found.checked < this->Droppers.size() &&
          this->areDropped(criterion, this->Bounds.offsets(this->Center, node), found.checked))
      {
        continue;
      }
      if (node.isSplit())
      {
        this->forEachChild(node, add);
      }
      else if (isWanted(found.nodeIndex))
      {
        const Offset y = this->offsetTo(found.nodeIndex);
        if (!this->isDropped(criterion, y))
        {
          visit(found.nodeIndex);
        }
        this->Droppers.push_back(y);
      }
    }
  }

  /// Visits a subset of the neighbors that covers all directions and distances: one leaf of each
  /// subtree whose bounding box of samples appears small from the leaf's sample. The subset depends
  /// only on the neighborhood. O(log n) for n neighbors on lines.
  /// @param size limit of a small box: its diagonal over its distance
  /// @param visit(nodeIndex) a leaf
  template <class Visitor>
  void forEachSpread(double size, const Visitor& visit) const
  {
    for (const std::size_t top : this->Tops)
    {
      this->visitSpread(top, size, visit);
    }
  }

private:
  /// A node in the search for survivors.
  struct Found
  {
    double squaredLength; // least of the offsets to its samples
    std::size_t nodeIndex;
    std::size_t checked; // droppers checked so far; none drops all of the node

    /// Reversed, since the standard heaps have the greatest element on top.
    bool operator<(const Found& other) const { return this->squaredLength > other.squaredLength; }
  };

  /// Takes neighbors from the smallest subtrees: near ones drop most of those behind them.
  void addNearDroppers()
  {
    constexpr std::size_t few = 8;
    for (const std::size_t top : this->Tops)
    {
      if (this->Tree.nodes[top].count() <= few)
      {
        this->Droppers.push_back(this->offsetTo(this->nearLeafBelow(top)));
      }
    }
  }

  void push(const Found& found)
  {
    this->Queue.push_back(found);
    std::push_heap(this->Queue.begin(), this->Queue.end());
  }

  /// Removes and returns the nearest node.
  Found pop()
  {
    std::pop_heap(this->Queue.begin(), this->Queue.end());
    const Found found = this->Queue.back();
    this->Queue.pop_back();
    return found;
  }

  template <class Visitor>
  void visitSpread(std::size_t nodeIndex, double size, const Visitor& visit) const
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (!node.isSplit())
    {
      requireLeaf(this->Tree, nodeIndex, this->Region);
      visit(nodeIndex);
    }
    else if (this->touchesBoth(node) && this->isSmall(node, size))
    {
      visit(this->leafBelow(nodeIndex));
    }
    else
    {
      this->forEachChild(node, [&](std::size_t child) { this->visitSpread(child, size, visit); });
    }
  }

  bool touchesBoth(const Node<TSample>& node) const
  {
    return node.plane >= this->Region.lower[node.axis] &&
           node.plane <= this->Region.upper[node.axis];
  }

  bool isSmall(const Node<TSample>& node, double size) const
  {
    const OffsetBounds offsets = this->Bounds.offsets(this->Center, node);
    const Vector diagonal = offsets.upper - offsets.lower;
    return dot(diagonal, diagonal) < size * size * offsets.minSquaredLength;
  }

  /// A leaf that touches the region, below a node that does.
  std::size_t leafBelow(std::size_t nodeIndex) const
  {
    const Node<TSample>* node = &this->Tree.nodes[nodeIndex];
    while (node->isSplit())
    {
      const bool isLower = node->plane >= this->Region.lower[node->axis];
      nodeIndex = isLower ? node->lowerNode() : node->upperNode();
      node = &this->Tree.nodes[nodeIndex];
    }
    requireLeaf(this->Tree, nodeIndex, this->Region);
    return nodeIndex;
  }

  /// One of the nearest neighbors below a node that touches the region. Requires canSearch().
  std::size_t nearLeafBelow(std::size_t nodeIndex) const
  {
    while (this->Tree.nodes[nodeIndex].isSplit())
    {
      double least = std::numeric_limits<double>::infinity();
      this->forEachChild(this->Tree.nodes[nodeIndex],
        [&](std::size_t child)
        {
          const double squaredLength =
            this->Bounds.offsets(this->Center, this->Tree.nodes[child]).minSquaredLength;
          if (squaredLength < least)
          {
            least = squaredLength;
            nodeIndex = child;
          }
        });
    }
    return nodeIndex;
  }

  template <class Visitor>
  void forEachChild(const Node<TSample>& node, const Visitor& visit) const
  {
    if (node.plane >= this->Region.lower[node.axis])
    {
      visit(node.lowerNode());
    }
    if (node.plane <= this->Region.upper[node.axis])
    {
      visit(node.upperNode());
    }
  }

  Offset offsetTo(std::size_t nodeIndex) const
  {
    const TSample& sample = this->Tree.sampleOf(nodeIndex);
    return offsetBetween(this->Center, positionOf(sample));
  }

  /// Whether a dropper, from number `first` on, certainly drops everything within the bounds.
  bool areDropped(
    const AngleCriterion& criterion, const OffsetBounds& offsets, std::size_t first) const
  {
    return std::any_of(this->Droppers.data() + first, this->Droppers.data() + this->Droppers.size(),
      [&](const Offset& z) { return criterion.dropsAll(z, offsets); });
  }

  /// Whether any neighbor drops y.
  bool isDropped(const AngleCriterion& criterion, const Offset& y) const
  {
    return std::any_of(this->Tops.begin(), this->Tops.end(),
      [&](std::size_t top)
      {
        return visitTouchingInSubtree(
          this->Tree, { top, 0 }, maximumDepth, this->Region,
          [&](const Node<TSample>& node)
          { return criterion.mayDrop(this->Bounds.offsets(this->Center, node), y); },
          [&](std::size_t nodeIndex)
          { return criterion.isDroppedBy(y, this->offsetTo(nodeIndex)); });
      });
  }

  const SampleTree<TSample>& Tree;
  SampleBounds<TSample>& Bounds;
  bool CanSearch;
  isopoint::Region Region{};
  Vector Center{};
  std::vector<std::size_t> Tops; // of the subtrees that touch the leaf's region
  std::vector<Found> Queue;      // a heap
  std::vector<Offset> Droppers;  // known neighbors: near ones and those of interest
};

} // namespace isopoint
