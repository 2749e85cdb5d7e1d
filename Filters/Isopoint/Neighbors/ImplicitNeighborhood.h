// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ImplicitNeighborhood_h
#define isopoint_ImplicitNeighborhood_h

#include "Isopoint/Neighbors/AngleCriterion.h"
#include "Isopoint/Neighbors/NeighborSearch.h"
#include "Isopoint/Tree/SampleBounds.h"
#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// The neighbourhood of a leaf, searched without listing it: what of it matters is found by the
/// bounding boxes of the samples below nodes. Neighbourhoods of n cells each, as of samples on two
/// skew lines, take a search of about O(log n) each. Scratch is kept from one leaf to the next.
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

  /// Whether no offset between samples is so long that its square overflows: then it cannot.
  bool canSearch() const { return this->CanSearch; }

  /// Goes to the neighbourhood of a leaf. The tree is to be refined there.
  /// @throws std::bad_alloc
  void moveTo(const Path& leaf)
  {
    this->Bounds.compute();
    this->Region = leaf.region;
    const TSample& sample = this->Tree.samples[this->Tree.nodes[leaf.nodeIndex()].begin];
    std::copy_n(sample.position, 3, this->Center);
    this->Tops.clear();
    forEachAcross(leaf,
      [this](FoundNode across)
      {
        this->Tops.push_back(across.nodeIndex);
        return false;
      });
  }

  /// Visits the neighbours that survive the angle criterion, in no particular order. Those that one
  /// next to the leaf, or found before, drops are left out by whole subtrees; whether any other
  /// neighbour drops what is left is searched for.
  /// @param enter(node) whether the node and those below it are of interest
  /// @param isWanted(nodeIndex) whether a leaf is
  /// @param visit(nodeIndex) called for each wanted one that survives
  template <class Filter, class Wanted, class Visitor>
  void forEachSurvivor(const AngleCriterion& criterion, const Filter& enter, const Wanted& isWanted,
    const Visitor& visit)
  {
    this->Droppers.clear();
    this->Queue.clear();
    this->Next.reset();
    this->addNearDroppers();
    const auto add = [&](std::size_t nodeIndex)
    {
      const Node<TSample>& node = this->Tree.nodes[nodeIndex];
      if (enter(node))
      {
        const OffsetBounds offsets = this->Bounds.offsets(this->Center, node);
        if (!this->areDropped(criterion, offsets, 0))
        {
          this->push({ offsets.leastSquaredLength, nodeIndex, this->Droppers.size() });
        }
      }
    };
    std::for_each(this->Tops.begin(), this->Tops.end(), add);
    while (const std::optional<Found> found = this->pop())
    {
      const Node<TSample>& node = this->Tree.nodes[found->nodeIndex];
      if (found->checked < this->Droppers.size() &&
          this->areDropped(criterion, this->Bounds.offsets(this->Center, node), found->checked))
      {
        continue;
      }
      if (node.isSplit())
      {
        this->forEachChild(node, add);
      }
      else if (isWanted(found->nodeIndex))
      {
        const Offset y = this->offsetTo(found->nodeIndex);
        if (!this->isDropped(criterion, y))
        {
          visit(found->nodeIndex);
        }
        this->Droppers.push_back(y);
      }
    }
  }

  /// Visits a neighbour for each direction and distance: all near ones, and one of those that are
  /// small as seen from the leaf's sample, side by side in the tree. The whole neighbourhood
  /// determines which, not what else of the tree is refined.
  /// @param size of the samples' bounding box, as a share of its distance
  /// @param visit(nodeIndex, count) of the leaf and about how many neighbours it stands for
  /// Complexity: O(log n) for n neighbours on lines
  template <class Visitor>
  void forEachSpread(double size, const Visitor& visit) const
  {
    for (const std::size_t top : this->Tops)
    {
      this->visitSpread(top, size, visit);
    }
  }

private:
  /// A node met in the search for survivors.
  struct Found
  {
    double squaredLength; // least of the offsets to its samples
    std::size_t nodeIndex;
    std::size_t checked; // droppers that do not drop all of it

    /// Whether it is farther: heaps have the greatest on top.
    bool operator<(const Found& other) const { return this->squaredLength > other.squaredLength; }
  };

  /// Those in the smallest subtrees stand side by side with the leaf's sample, and so drop most of
  /// what lies behind them.
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

  void push(Found found)
  {
    if (!this->Next)
    {
      this->Next = found;
      return;
    }
    if (*this->Next < found)
    {
      std::swap(*this->Next, found);
    }
    this->Queue.push_back(found);
    std::push_heap(this->Queue.begin(), this->Queue.end());
  }

  /// Takes out the nearest of those pushed, if there is one.
  std::optional<Found> pop()
  {
    const bool isNext = this->Next && (this->Queue.empty() || !(*this->Next < this->Queue.front()));
    if (isNext || this->Queue.empty())
    {
      return std::exchange(this->Next, std::nullopt);
    }
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
      visit(nodeIndex, std::size_t{ 1 });
    }
    else if (this->touchesBoth(node) && this->isSmall(node, size))
    {
      visit(this->leafBelow(nodeIndex), node.count());
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
    const Vector diagonal = difference({ offsets.upper[0], offsets.upper[1], offsets.upper[2] },
      { offsets.lower[0], offsets.lower[1], offsets.lower[2] });
    return dot(diagonal, diagonal) < size * size * offsets.leastSquaredLength;
  }

  /// A leaf below a node that touches the region, and that touches it as well.
  std::size_t leafBelow(std::size_t nodeIndex) const
  {
    const Node<TSample>* node = &this->Tree.nodes[nodeIndex];
    while (node->isSplit())
    {
      const bool isLower = node->plane >= this->Region.lower[node->axis];
      nodeIndex = isLower ? node->lowerNode() : node->upperNode();
      node = &this->Tree.nodes[nodeIndex];
    }
    return nodeIndex;
  }

  /// One of the nearest neighbours below a node that touches the region, as long as it canSearch().
  std::size_t nearLeafBelow(std::size_t nodeIndex) const
  {
    while (this->Tree.nodes[nodeIndex].isSplit())
    {
      double least = std::numeric_limits<double>::infinity();
      this->forEachChild(this->Tree.nodes[nodeIndex],
        [&](std::size_t child)
        {
          const double squaredLength =
            this->Bounds.offsets(this->Center, this->Tree.nodes[child]).leastSquaredLength;
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
    const TSample& sample = this->Tree.samples[this->Tree.nodes[nodeIndex].begin];
    const double position[3] = { sample.position[0], sample.position[1], sample.position[2] };
    return offsetBetween(this->Center, position);
  }

  /// Whether one of the droppers from the given one on certainly drops all within the bounds.
  bool areDropped(
    const AngleCriterion& criterion, const OffsetBounds& offsets, std::size_t first) const
  {
    return std::any_of(this->Droppers.begin() + static_cast<std::ptrdiff_t>(first),
      this->Droppers.end(), [&](const Offset& z) { return criterion.dropsAll(z, offsets); });
  }

  /// Whether any neighbour drops that one.
  bool isDropped(const AngleCriterion& criterion, const Offset& y) const
  {
    return std::any_of(this->Tops.begin(), this->Tops.end(),
      [&](std::size_t top)
      {
        return visitTouchingInSubtree(
          this->Tree, { top, 0 }, maximumDepth, this->Region,
          [&](const Node<TSample>& node)
          { return criterion.mayDrop(this->Bounds.offsets(this->Center, node), y); },
          [&](std::size_t nodeIndex) { return criterion.isDroppedBy(y, this->offsetTo(nodeIndex)); });
      });
  }

  const SampleTree<TSample>& Tree;
  SampleBounds<TSample>& Bounds;
  bool CanSearch;
  isopoint::Region Region{};
  double Center[3]{};
  std::vector<std::size_t> Tops; // of the subtrees that touch the leaf's region
  std::optional<Found> Next;     // often the nearest of all, kept out of the heap
  std::vector<Found> Queue;      // of the others
  std::vector<Offset> Droppers;  // neighbours known so far: near ones, and those of interest
};

} // namespace isopoint

#endif
