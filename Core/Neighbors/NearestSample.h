// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"
#include "Core/Tree/SampleTree.h"

#include <cmath>
#include <cstddef>

namespace isopoint
{

/// A ball in which samples are searched; see searchRegion().
template <class TSample>
class BallSearch
{
public:
  BallSearch(const SampleTree<TSample>& tree, const Vector& center, double radius)
    : Tree(tree)
    , Center(center)
    , Radius(radius)
  {
  }

  bool mayHold(const Node<TSample>& /*node*/, const Region& region) const
  {
    const Vector gap = gapTo(region, this->Center);
    constexpr double slack = 0.999; // for rounding
    return slack * slack * dot(gap, gap) <= this->Radius * this->Radius;
  }

  bool isUpperFirst(const Node<TSample>& node) const
  {
    return this->Center[node.axis] > node.plane;
  }

  Region needed(const Region& region) const
  {
    return partWithin(region, this->Center, this->Radius);
  }

protected:
  const SampleTree<TSample>& Tree;
  const Vector Center;
  double Radius;
};

/// The condition of a NearestSampleSearch that every sample meets.
struct AnySample
{
  /// Whether a sample in a region may meet the condition.
  bool mayHoldIn(const Region& /*region*/) const { return true; }

  /// Whether a sample meets the condition, given its offset from the center and the offset's
  /// length.
  bool holdsAt(const Vector& /*offset*/, double /*length*/) const { return true; }
};

/// Finds the sample nearest to a position that meets a condition; the lowest id among equals.
template <class TSample, class TCondition = AnySample>
class NearestSampleSearch : public BallSearch<TSample>
{
public:
  /// @param reach search radius, finite
  /// @param condition has the functions of AnySample
  NearestSampleSearch(const SampleTree<TSample>& tree, const Vector& center, double reach,
    const TCondition& condition = {})
    : BallSearch<TSample>(tree, center, reach)
    , Condition(condition)
  {
  }

  /// O(log n) mostly, plus samples of unsplit nodes. Independent of tree refinement.
  /// @returns null if there is none
  /// @throws MissingNode at a node whose samples another rank holds
  const TSample* search()
  {
    if (!this->Tree.isEmpty())
    {
      searchRegion(this->Tree, rootNode, this->needed(this->Tree.region), *this);
    }
    return this->Found;
  }

  bool mayHold(const Node<TSample>& node, const Region& region) const
  {
    return BallSearch<TSample>::mayHold(node, region) && this->Condition.mayHoldIn(region);
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
  void consider(const TSample& sample)
  {
    const Vector offset = positionOf(sample) - this->Center;
    // Comparing components is far faster than the length, which is never less than one.
    if (std::abs(offset[0]) > this->Radius || std::abs(offset[1]) > this->Radius ||
        std::abs(offset[2]) > this->Radius)
    {
      return;
    }
    const double distance = lengthOf(offset);
    const bool isNearer =
      distance < this->Radius ||
      (distance == this->Radius && (!this->Found || sample.id < this->Found->id));
    if (isNearer && this->Condition.holdsAt(offset, distance))
    {
      this->Radius = distance;
      this->Found = &sample;
    }
  }

  const TCondition Condition;
  const TSample* Found = nullptr;
};

} // namespace isopoint
