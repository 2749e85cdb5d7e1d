// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleExtent_h
#define isopoint_SampleExtent_h

#include "ExtentQuery.h"
#include "NeighborSearch.h"
#include "SampleTree.h"
#include "Vector.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// The samples ahead of a place, as they are met.
class SamplesAhead
{
public:
  explicit SamplesAhead(const ExtentQuery& query)
    : Query(query)
  {
  }

  void add(const Vector& position)
  {
    const Vector offset = difference(position, this->Query.place);
    const double height = dot(offset, this->Query.normal);
    const double ahead = dot(offset, this->Query.direction);
    const double length = lengthOf(offset);
    constexpr double leastCosine = 0.70710678118654752; // 1 / sqrt 2
    if (ahead < leastCosine * length || length > this->Query.reach)
    {
      return;
    }
    if (height >= 0.0)
    {
      this->Above = std::max(this->Above, ahead);
    }
    if (height <= 0.0)
    {
      this->Below = std::max(this->Below, ahead);
    }
  }

  double extent() const { return std::min({ this->Above, this->Below, this->Query.enough }); }
  bool isEnough() const { return this->extent() >= this->Query.enough; }

private:
  const ExtentQuery& Query;
  double Above = 0.0;
  double Below = 0.0;
};

/// How far samples stand ahead of a place on both sides of the plane through it that is tangent to
/// the surface: the largest component along the direction that the offset of one has, of those
/// within 45 degrees of it and within reach, on the side where they stand less far; at most what is
/// enough, and 0 where there is none. The same however much of the tree is refined.
/// Complexity: O(log n) where samples are far enough off, O(log n + samples within reach) where
/// none are.
template <class TSample>
double extentOfSamples(const SampleTree<TSample>& tree, const ExtentQuery& query)
{
  SamplesAhead found(query);
  const auto visit = [&](std::size_t slot)
  {
    const Node<TSample>& node = tree.nodes[slot];
    const std::size_t end = node.isLeaf ? node.begin + 1 : node.end;
    for (std::size_t i = node.begin; i < end && !found.isEnough(); ++i)
    {
      const auto* const position = tree.samples[i].position;
      found.add({ position[0], position[1], position[2] });
    }
    return found.isEnough();
  };
  const auto search = [&](double ahead, double half)
  {
    const Vector center = sum(query.place, ahead, query.direction);
    Region box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = center[axis] - half;
      box.upper[axis] = center[axis] + half;
    }
    return visitTouchingInSubtree(
      tree, FoundNode{ SampleTree<TSample>::rootSlot, 0 }, maximumDepth, box,
      [](const Node<TSample>&) { return true; }, visit);
  };
  // Mostly the first few samples will do; all that count lie in a ball that touches the place.
  constexpr double share = 0.2;
  const double beyond = query.reach - query.enough;
  if (!search(query.enough + 0.5 * beyond, share * beyond))
  {
    constexpr double radius = 0.70710678118654752; // of the ball around the cone of 45 degrees
    search(radius * query.reach, radius * query.reach);
  }
  return found.extent();
}

} // namespace isopoint

#endif
