// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Neighbors/GapCriterion.h"
#include "Core/Neighbors/SampleSpacing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isopoint
{

/// Rejects edges that span a void: another criterion rejects them, and one of seven balls on them
/// is empty. Balls are around the seven points that divide an edge into eight equal parts; their
/// radius is a factor times the spacing, the distance from an end to the tenth nearest position,
/// the larger of both ends. Long edges of slivers on the convex hull pass, because samples are
/// close to them. Edges from rim to rim need no other criterion: see joinsRims().
template <class TCriterion>
class VoidCriterion
{
public:
  VoidCriterion(const TCriterion& criterion, double factor)
    : Criterion(criterion)
    , Factor(factor)
  {
  }

  /// Whether an edge is rejected. Symmetric; throws and takes time as GapCriterion::rejects().
  /// @param spacings of the two ends
  template <class TSample>
  bool rejects(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other, const std::array<SampleSpacing, 2>& spacings) const
  {
    const double spacing = std::max(spacings[0].tenth, spacings[1].tenth);
    constexpr double slack = 1.001; // for rounding
    const bool mayHoldNoEnd =
      2.0 * this->Factor * spacing < slack * lengthOf(positionOf(other) - positionOf(own));
    // The other criterion takes long for edges of slivers, which are long.
    return mayHoldNoEnd &&
           this->isBare(tree, positionOf(own), positionOf(other), this->Factor * spacing) &&
           (this->Criterion.rejects(tree, bounds, own, other) ||
             this->joinsRims(tree, bounds, own, other, spacings));
  }

private:
  /// Whether an edge goes from rim to rim: a ball of two spacings is empty, nothing is behind
  /// either end, and the samples around both ends extend along the edge, unlike between layers or
  /// lines.
  template <class TSample>
  static bool joinsRims(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds,
    const TSample& own, const TSample& other, const std::array<SampleSpacing, 2>& spacings)
  {
    constexpr double bareFactor = 2.0;
    const double spacing = std::max(spacings[0].tenth, spacings[1].tenth);
    const Vector edge = positionOf(other) - positionOf(own);
    // The quicker tests come first: lines have many such edges.
    return isBare(tree, positionOf(own), positionOf(other), bareFactor * spacing) &&
           extendsAlong(tree, own, edge, spacings[0]) &&
           extendsAlong(tree, other, edge, spacings[1]) &&
           !GapCriterion::beyond().isDense(tree, bounds, own, other) &&
           !GapCriterion::beyond().isDense(tree, bounds, other, own);
  }

  /// Whether one of the ten nearest positions is as far from an end, measured along the edge, as
  /// the nearest one is in any direction.
  template <class TSample>
  static bool extendsAlong(const SampleTree<TSample>& tree, const TSample& end, const Vector& edge,
    const SampleSpacing& spacing)
  {
    const double least = spacing.nearest * lengthOf(edge);
    const auto isAlong = [&](const Vector& offset) { return std::abs(dot(offset, edge)) >= least; };
    return AnyInBallSearch(tree, positionOf(end), spacing.tenth, isAlong).hasAny();
  }

  /// Whether one of the balls is empty. The same from either end.
  template <class TSample>
  static bool isBare(
    const SampleTree<TSample>& tree, const Vector& a, const Vector& b, double radius)
  {
    constexpr int partCount = 8;
    const auto isAny = [](const Vector& /*offset*/) { return true; };
    bool isBare = false;
    for (int i = 1; i < partCount && !isBare; ++i)
    {
      const double share = static_cast<double>(i) / partCount;
      const Vector center = (1.0 - share) * a + share * b;
      isBare = lengthOf(center - (i <= partCount / 2 ? a : b)) > radius &&
               !AnyInBallSearch(tree, center, radius, isAny).hasAny();
    }
    return isBare;
  }

  TCriterion Criterion;
  double Factor;
};

/// The criterion of edges that start a gap in a body or a slice.
inline VoidCriterion<GapCriterion> strongVoidCriterion()
{
  constexpr double strongVoidFactor = 1.0;
  return { GapCriterion::strong(), strongVoidFactor };
}

/// The criterion of edges connected with such a gap.
inline VoidCriterion<RimCriterion> weakVoidCriterion()
{
  constexpr double weakVoidFactor = 0.7;
  return { RimCriterion(), weakVoidFactor };
}

} // namespace isopoint
