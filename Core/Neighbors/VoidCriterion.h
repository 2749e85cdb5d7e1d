// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/NearestSample.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// Rejects edges that span a void. Another criterion rejects such an edge, and a ball around one of
/// the seven points that divide it into eight equal parts has no samples: its radius is a factor
/// times the spacing, the distance from an end to the tenth nearest position, the greater of both
/// ends. Long edges of slivers on the convex hull pass, because samples inside are close to them.
template <class TCriterion>
class VoidCriterion
{
public:
  VoidCriterion(const TCriterion& criterion, double factor)
    : Criterion(criterion)
    , Factor(factor)
  {
  }

  /// As GapCriterion::drops().
  template <class TSample>
  bool drops(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    // The other criterion takes long for edges of slivers, which are long.
    return this->isBare(tree, bounds, own, other) &&
           this->Criterion.drops(tree, bounds, own, other);
  }

private:
  static constexpr int partCount = 8;

  /// Whether one of the balls is empty.
  template <class TSample>
  bool isBare(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    // An end is never farther than half the length.
    constexpr double maxShare = 0.5;
    if (!this->isLonger(tree, bounds, own, other, maxShare))
    {
      return false;
    }
    const double length = offsetBetween(positionOf(own), positionOf(other)).length;
    return this->isLonger(
      tree, bounds, own, other, largestBall(tree, positionOf(own), positionOf(other)) / length);
  }

  /// Whether a share of the edge is longer than the factor times the spacing at both ends.
  template <class TSample>
  bool isLonger(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other, double share) const
  {
    constexpr std::size_t spacingCount = 10;
    constexpr double allAround = -2.0;
    const GapCriterion around{ this->Factor / share, spacingCount, allAround };
    return around.drops(tree, bounds, own, other);
  }

  /// The greatest radius of an empty ball around a dividing point. The same from either end.
  template <class TSample>
  static double largestBall(const SampleTree<TSample>& tree, const Vector& a, const Vector& b)
  {
    double largest = 0.0;
    for (int i = 1; i < partCount; ++i)
    {
      const double share = static_cast<double>(i) / partCount;
      const Vector place = (1.0 - share) * a + share * b;
      const double reach = offsetBetween(place, i <= partCount / 2 ? a : b).length;
      const TSample* const nearest =
        NearestSampleSearch<TSample>(tree, place, 1.001 * reach).search();
      largest = std::max(largest, lengthOf(positionOf(*nearest) - place));
    }
    return largest;
  }

  TCriterion Criterion;
  double Factor;
};

/// The criterion of edges that start a gap in a body or a slice.
inline VoidCriterion<GapCriterion> strongVoids()
{
  return { GapCriterion::strong(), 1.0 };
}

/// The criterion of edges connected with such a gap.
inline VoidCriterion<RimCriterion> weakVoids()
{
  return { RimCriterion(), 0.7 };
}

} // namespace isopoint
