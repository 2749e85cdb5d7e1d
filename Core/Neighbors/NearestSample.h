// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// The condition of a NearestSampleSearch that every sample meets.
struct AnySample
{
  /// Whether a sample in a region may meet the condition.
  bool mayHoldIn(const Region& /*region*/) const { return true; }

  /// Whether a sample meets the condition, given its offset from the place and its length.
  bool holdsAt(const Vector& /*offset*/, double /*length*/) const { return true; }
};

/// Finds the nearest sample to a place that meets a condition; the lowest id among equals.
template <class TSample, class TCondition = AnySample>
class NearestSampleSearch
{
public:
  /// @param reach search radius, finite
  /// @param condition has the functions of AnySample
  NearestSampleSearch(const SampleTree<TSample>& tree, const Vector& place, double reach,
    const TCondition& condition = {})
    : Tree(tree)
    , Place(place)
    , Condition(condition)
    , Distance(reach)
  {
  }

  /// O(log n) mostly, plus samples of unsplit nodes. Independent of tree refinement.
  /// @returns null if there is none
  /// @throws MissingNode at a node whose samples another rank holds
  const TSample* search()
  {
    if (!this->Tree.isEmpty())
    {
      searchRegion(
        this->Tree, SampleTree<TSample>::rootNode, this->needed(this->Tree.region), *this);
    }
    return this->Found;
  }

  // For searchRegion().

  bool mayHold(const Node<TSample>& /*node*/, const Region& region) const
  {
    return this->isNear(region) && this->Condition.mayHoldIn(region);
  }

  bool isUpperFirst(const Node<TSample>& node) const { return this->Place[node.axis] > node.plane; }

  Region needed(const Region& region) const
  {
    return partWithin(region, this->Place, this->Distance);
  }

  bool add(std::size_t nodeIndex)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    for (std::size_t i = node.begin; i < node.positionsEnd(); ++i)
    {
      this->consider(this->Tree.samples[i]);
    }
    return false;
  }

private:
  /// Whether a region may hold a sample as near as the nearest found.
  bool isNear(const Region& region) const
  {
    const Vector gap = gapTo(region, this->Place);
    constexpr double slack = 0.999; // for rounding
    return !this->isFarther(gap) && slack * lengthOf(gap) <= this->Distance;
  }

  /// Compares components only. That is far faster than the length, which is never less than a
  /// component, rounding included.
  bool isFarther(const Vector& offset) const
  {
    return std::abs(offset[0]) > this->Distance || std::abs(offset[1]) > this->Distance ||
           std::abs(offset[2]) > this->Distance;
  }

  void consider(const TSample& sample)
  {
    const Vector offset = positionOf(sample) - this->Place;
    if (this->isFarther(offset))
    {
      return;
    }
    const double distance = lengthOf(offset);
    const bool isNearer =
      distance < this->Distance ||
      (distance == this->Distance && (!this->Found || sample.id < this->Found->id));
    if (isNearer && this->Condition.holdsAt(offset, distance))
    {
      this->Distance = distance;
      this->Found = &sample;
    }
  }

  const SampleTree<TSample>& Tree;
  const Vector Place;
  const TCondition Condition;
  double Distance;
  const TSample* Found = nullptr;
};

} // namespace isopoint
