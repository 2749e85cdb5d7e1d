// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NearestSample_h
#define isopoint_NearestSample_h

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

  /// Whether a sample at an offset from the place, of this length, meets the condition.
  bool holdsAt(const Vector& /*offset*/, double /*length*/) const { return true; }
};

/// Searches for the sample nearest to a place of those that meet a condition, of equally distant
/// ones that of the lowest id.
template <class TSample, class TCondition = AnySample>
class NearestSampleSearch
{
public:
  /// @param reach of the samples that count from the place, finite
  /// @param condition with the functions of AnySample
  NearestSampleSearch(const SampleTree<TSample>& tree, const Vector& place, double reach,
    const TCondition& condition = {})
    : Tree(tree)
    , Place(place)
    , Condition(condition)
    , Distance(reach)
  {
  }

  /// @returns null if there is none. The same however much of the tree is refined.
  /// @throws MissingNode at a node whose samples another rank holds
  /// Complexity: O(log n), mostly, and the samples of unsplit nodes on the way
  const TSample* search()
  {
    if (!this->Tree.isEmpty())
    {
      const Region box = this->within(this->Tree.region);
      this->visit(smallestAround(this->Tree, SampleTree<TSample>::rootNode, box), box);
    }
    return this->Found;
  }

private:
  /// @param region a part of the node's that contains all samples of it that count
  void visit(std::size_t nodeIndex, const Region& region)
  {
    if (!this->isNear(region) || !this->Condition.mayHoldIn(region))
    {
      return;
    }
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (node.isSplit())
    {
      const bool isUpperFirst = this->Place[node.axis] > node.plane;
      for (const bool isUpper : { isUpperFirst, !isUpperFirst })
      {
        Region part = region;
        (isUpper ? part.lower : part.upper)[node.axis] = node.plane;
        this->visit(this->Tree.child(node, isUpper), part);
      }
      return;
    }
    if (node.isAbsent)
    {
      throw MissingNode{ nodeIndex, this->within(region) };
    }
    const std::size_t end = node.isLeaf ? node.begin + 1 : node.end;
    for (std::size_t i = node.begin; i < end; ++i)
    {
      this->consider(this->Tree.samples[i]);
    }
  }

  /// Whether a region may hold a sample as near as the nearest found.
  bool isNear(const Region& region) const
  {
    Vector gap{};
    for (int axis = 0; axis < 3; ++axis)
    {
      gap[axis] = std::max(
        { region.lower[axis] - this->Place[axis], this->Place[axis] - region.upper[axis], 0.0 });
    }
    constexpr double slack = 0.999; // for rounding
    return !this->isFarther(gap) && slack * lengthOf(gap) <= this->Distance;
  }

  /// Whether an offset is longer than the distance of the nearest found along one axis alone, and
  /// so is its length, which is not rounded to less than a component: lengths take far longer to
  /// compute.
  bool isFarther(const Vector& offset) const
  {
    return std::abs(offset[0]) > this->Distance || std::abs(offset[1]) > this->Distance ||
           std::abs(offset[2]) > this->Distance;
  }

  /// The part of a region that is near enough, with room for rounding.
  Region within(Region region) const
  {
    const double reach = 1.001 * this->Distance;
    for (int axis = 0; axis < 3; ++axis)
    {
      region.lower[axis] = std::max(region.lower[axis], this->Place[axis] - reach);
      region.upper[axis] = std::min(region.upper[axis], this->Place[axis] + reach);
    }
    return region;
  }

  void consider(const TSample& sample)
  {
    const Vector offset = difference(positionOf(sample), this->Place);
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

#endif
