// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LargeNeighborhood_h
#define isopoint_LargeNeighborhood_h

#include "AngleCriterion.h"
#include "NeighborSearch.h"
#include "SampleBounds.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace isopoint
{

/// Which neighbourhoods are listed, and which searched as LargeNeighborhood does: listing is quicker
/// for small ones, and for a few large ones as well. The large ones that are listed add up to O(n)
/// neighbours. No result depends on it. Shared by all threads.
template <class TSample>
class ListingLimit
{
public:
  explicit ListingLimit(const SampleTree<TSample>& tree)
    : Budget(static_cast<std::int64_t>(tree.samples.size()))
  {
    // Bounds on offsets hold where nothing overflows.
    const OffsetBounds extent =
      offsetsToBox(tree.region.lower, tree.region.lower, tree.region.upper);
    this->IsLimited = extent.greatestSquaredLength < std::numeric_limits<double>::max() / 16.0;
  }

  /// How many neighbours to list before giving up.
  std::size_t most() const
  {
    return this->IsLimited && this->Budget.load(std::memory_order_relaxed) <= 0
             ? fewNeighbors
             : std::numeric_limits<std::size_t>::max();
  }

  /// Tells of a neighbourhood that was listed.
  void listed(std::size_t count)
  {
    if (count > fewNeighbors)
    {
      this->Budget.fetch_sub(static_cast<std::int64_t>(count), std::memory_order_relaxed);
    }
  }

private:
  static constexpr std::size_t fewNeighbors = 64;

  std::atomic<std::int64_t> Budget;
  bool IsLimited;
};

/// The neighbourhood of a leaf, searched without listing it: what of it matters is found by the
/// bounding boxes of the samples below nodes. Neighbourhoods of n cells each, as of samples on two
/// skew lines, take a search of about O(log n) each. Scratch is kept from one leaf to the next.
template <class TSample>
class LargeNeighborhood
{
public:
  LargeNeighborhood(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds)
    : Tree(tree)
    , Bounds(bounds)
  {
  }

  /// Goes to the neighbourhood of a leaf. The tree is to be refined there.
  /// @throws std::bad_alloc
  void moveTo(const Path& leaf)
  {
    this->Bounds.compute();
    this->Region = leaf.region;
    const TSample& sample = this->Tree.samples[this->Tree.nodes[leaf.slot()].begin];
    std::copy_n(sample.position, 3, this->Center);
    this->Tops.clear();
    forEachAcross(leaf, [this](FoundNode across)
      {
        this->Tops.push_back(across.slot);
        return false;
      });
  }

  /// Visits the neighbours that survive the angle criterion, in no particular order. Those that a
  /// survivor drops are left out by whole subtrees, and whether another one drops what is left is
  /// asked of all neighbours.
  /// @param enter(node) whether the node and those below it are of interest
  /// @param isWanted(slot) whether a leaf is
  /// @param visit(slot) called for each wanted one that survives
  template <class Filter, class Wanted, class Visitor>
  void forEachSurvivor(const AngleCriterion& criterion, const Filter& enter, const Wanted& isWanted,
    const Visitor& visit)
  {
    this->Droppers.clear();
    this->nearestFirst(
      [&](const Node<TSample>& node, const OffsetBounds& offsets)
      {
        return enter(node) && std::none_of(this->Droppers.begin(), this->Droppers.end(),
                                [&](const Offset& z) { return criterion.dropsAll(z, offsets); });
      },
      [&](std::size_t slot)
      {
        const Offset y = this->offsetTo(slot);
        const auto drops = [&](const Offset& z) { return criterion.isDroppedBy(y, z); };
        if (isWanted(slot) && std::none_of(this->Droppers.begin(), this->Droppers.end(), drops))
        {
          if (!this->isDropped(criterion, y))
          {
            visit(slot);
          }
          this->Droppers.push_back(y);
        }
        return false;
      });
  }

private:
  struct Found
  {
    double squaredLength; // least of the offsets to the node's samples
    std::size_t slot;

    bool operator<(const Found& other) const { return this->squaredLength > other.squaredLength; }
  };

  Offset offsetTo(std::size_t slot) const
  {
    const TSample& sample = this->Tree.samples[this->Tree.nodes[slot].begin];
    const double position[3] = { sample.position[0], sample.position[1], sample.position[2] };
    return offsetBetween(this->Center, position);
  }

  /// Visits the neighbours by their distance.
  /// @param enter(node, offsets) asked again before the node's children are searched
  /// @param visit(slot) returns whether to end the search
  template <class Filter, class Visitor>
  void nearestFirst(const Filter& enter, const Visitor& visit)
  {
    this->Queue.clear();
    const auto add = [&](std::size_t slot)
    {
      const Node<TSample>& node = this->Tree.nodes[slot];
      const OffsetBounds offsets = this->Bounds.offsets(this->Center, node);
      if (enter(node, offsets))
      {
        this->Queue.push_back({ offsets.leastSquaredLength, slot });
        std::push_heap(this->Queue.begin(), this->Queue.end());
      }
    };
    std::for_each(this->Tops.begin(), this->Tops.end(), add);
    while (!this->Queue.empty())
    {
      std::pop_heap(this->Queue.begin(), this->Queue.end());
      const std::size_t slot = this->Queue.back().slot;
      this->Queue.pop_back();
      const Node<TSample>& node = this->Tree.nodes[slot];
      if (!node.isSplit())
      {
        if (visit(slot))
        {
          return;
        }
        continue;
      }
      if (!enter(node, this->Bounds.offsets(this->Center, node)))
      {
        continue;
      }
      if (node.plane >= this->Region.lower[node.axis])
      {
        add(node.lowerSlot());
      }
      if (node.plane <= this->Region.upper[node.axis])
      {
        add(node.upperSlot());
      }
    }
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
          [&](std::size_t slot) { return criterion.isDroppedBy(y, this->offsetTo(slot)); });
      });
  }

  const SampleTree<TSample>& Tree;
  SampleBounds<TSample>& Bounds;
  isopoint::Region Region{};
  double Center[3]{};
  std::vector<std::size_t> Tops; // of the subtrees that touch the leaf's region
  std::vector<Found> Queue;
  std::vector<Offset> Droppers;
};

} // namespace isopoint

#endif
