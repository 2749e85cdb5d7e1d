// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tree/SampleBounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// Rejects edges across gaps in the cloud. The spacing behind the end x of an edge {x, y} is the
/// distance from x to the `count`-th nearest sample position in the cone around the direction from
/// y to x (with a half angle of 54.7356 degrees by default), infinite if there are fewer. An end is
/// dense if the edge is longer than `factor` times the spacing behind it. An edge is rejected if
/// both ends are dense.
/// - All samples count, neighbors of x or not: cells at the border of a void stretch across it and
///   need not touch the cells of the samples nearest to x.
/// - Only samples behind x count: on lines and in slices, samples are much closer to each other
///   than to those of the next line or slice.
/// - Both ends must agree, so that edges from a dense region to a sparse one stay.
class GapCriterion
{
public:
  /// The cosine of the half angle of the cone behind an end: 1 / sqrt 3.
  static constexpr double coneCosine = 1.0 / 1.7320508075688772;

  /// @param factor positive
  /// @param count rank of the sample behind an end that defines the spacing: 1 to 3
  /// @param cosine of the cone's half angle; 0 for the half-space behind an end
  GapCriterion(double factor, std::size_t count, double cosine = coneCosine)
    : Factor(factor)
    , WantedCount(count)
    , Cosine(cosine)
  {
  }

  /// The criterion of edges connected with a gap: rejected ones are part of it.
  static GapCriterion weak() { return { 2.0, 2 }; }

  /// The criterion of edges that start a gap. It rejects almost no edges of clouds without gaps.
  /// @param ratio of the edge's length to that of its part across the gap, at least 1
  static GapCriterion strong(double ratio = 1.0) { return { 4.0 * ratio, 3 }; }

  /// Its dense ends have at least two samples behind them within twice the edge's length.
  static GapCriterion beyond() { return { 0.5, 2 }; }

  /// Whether the edge between two samples is rejected. Symmetric. Independent of tree refinement.
  /// @param bounds of the tree's samples; computed if a search visits many nodes
  /// @throws MissingNode at a node whose samples another rank holds
  /// Complexity: O(depth + nodes within length / factor of an end that may have samples in its
  /// cone); a partial tree's nodes are judged by their regions
  template <class TSample>
  bool rejects(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    return this->isDense(tree, bounds, own, other) && this->isDense(tree, bounds, other, own);
  }

  /// Whether an end is dense; see rejects().
  template <class TSample>
  bool isDense(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& end,
    const TSample& other) const
  {
    const Vector center = positionOf(end);
    SearchBehind<TSample> search{ *this, tree, bounds, center,
      offsetBetween(center, positionOf(other)), {} };
    return bounds.areOfLeaves() && !tree.isEmpty()
             ? search.searchBoxes(rootNode)
             : searchRegion(tree, rootNode, this->boxAround(center, search.edge.length), search);
  }

  /// A quick test: if false, no edge of the leaf's sample up to this length is rejected.
  template <class TSample>
  bool mayReject(
    const SampleTree<TSample>& tree, const Path& leaf, const TSample& own, double length) const
  {
    const auto isNear = [&](const TSample& sample)
    {
      return this->Factor * offsetBetween(positionOf(own), positionOf(sample)).length < length &&
             !haveOnePosition(own, sample);
    };
    Found<TSample> found;
    return visitAround(tree, leaf, this->boxAround(positionOf(own), length),
      [&](std::size_t nodeIndex) { return this->add(tree, nodeIndex, isNear, found); });
  }

private:
  static constexpr std::size_t maxWanted = 3;

  /// Positions found behind an end, each once.
  template <class TSample>
  struct Found
  {
    std::array<const TSample*, maxWanted> samples;
    std::size_t count = 0;

    void add(const TSample& sample)
    {
      for (std::size_t i = 0; i < this->count; ++i)
      {
        if (haveOnePosition(*this->samples[i], sample))
        {
          return;
        }
      }
      this->samples[this->count++] = &sample;
    }
  };

  /// A search behind an end of an edge, until enough samples are found; see searchRegion().
  template <class TSample>
  struct SearchBehind
  {
    const GapCriterion& criterion;
    const SampleTree<TSample>& tree;
    SampleBounds<TSample>& bounds;
    Vector center; // the end
    Offset edge;   // to the other end
    Found<TSample> found;
    std::size_t visited = 0; // nodes

    bool mayHold(const Node<TSample>& node, const Region& region)
    {
      if (!this->mayHold(offsetsToBox(this->center, region.lower, region.upper)))
      {
        return false;
      }
      // Regions mostly suffice, but extend far beyond samples on lines and sheets.
      constexpr std::size_t many = 256;
      if (!node.isSplit() || ++this->visited <= many || this->tree.isPartial)
      {
        return true;
      }
      this->bounds.compute();
      return this->mayHold(this->bounds.offsets(this->center, node));
    }

    /// The same search in the boxes of samples alone, a few times faster on lines.
    bool searchBoxes(std::size_t nodeIndex)
    {
      const Node<TSample>& node = this->tree.nodes[nodeIndex];
      if (!node.isSplit())
      {
        return this->add(nodeIndex);
      }
      if (!this->mayHold(this->bounds.box(node)))
      {
        return false;
      }
      const bool isUpperFirst = this->isUpperFirst(node);
      return this->searchBoxes(this->tree.child(node, isUpperFirst)) ||
             this->searchBoxes(this->tree.child(node, !isUpperFirst));
    }

    /// Whether a sample in a box may be behind the end, as far as quick tests tell.
    bool mayHold(const Region& box) const
    {
      constexpr double slack = 0.999; // for rounding
      double squaredGap = 0.0;
      double greatest = 0.0; // component behind the end, times the edge's length
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double lower = box.lower[axis] - this->center[axis];
        const double upper = box.upper[axis] - this->center[axis];
        const double gap = std::max(std::max(lower, -upper), 0.0);
        squaredGap += gap * gap;
        const double along = -this->edge.vector[axis];
        greatest += std::max(lower * along, upper * along);
      }
      const double gap = slack * std::sqrt(squaredGap);
      return this->criterion.Factor * gap <= this->edge.length &&
             greatest >= this->criterion.Cosine * (gap * this->edge.length);
    }

    /// Whether a sample whose offset is within bounds may be behind the end. Rounding is monotonic.
    bool mayHold(const OffsetBounds& offsets) const
    {
      const double least = std::sqrt(offsets.minSquaredLength);
      return this->criterion.Factor * least < this->edge.length &&
             -minProduct(this->edge, offsets) >=
               this->criterion.Cosine * (least * this->edge.length);
    }

    bool isUpperFirst(const Node<TSample>& node) const
    {
      return this->center[node.axis] > node.plane;
    }

    Region needed(const Region& /*region*/) const
    {
      return this->criterion.boxAround(this->center, this->edge.length);
    }

    bool add(std::size_t nodeIndex)
    {
      const auto isBehind = [this](const TSample& sample)
      {
        const Offset offset = offsetBetween(this->center, positionOf(sample));
        return this->criterion.Factor * offset.length < this->edge.length &&
               -dot(offset.vector, this->edge.vector) >
                 this->criterion.Cosine * (offset.length * this->edge.length);
      };
      return this->criterion.add(this->tree, nodeIndex, isBehind, this->found);
    }
  };

  /// Adds samples of an unsplit node. @returns whether enough are found
  template <class TSample, class Kind>
  bool add(const SampleTree<TSample>& tree, std::size_t nodeIndex, const Kind& isWanted,
    Found<TSample>& found) const
  {
    const Node<TSample>& node = tree.nodes[nodeIndex];
    const std::size_t end = node.positionsEnd();
    for (std::size_t i = node.begin; i < end && found.count < this->WantedCount; ++i)
    {
      if (isWanted(tree.samples[i]))
      {
        found.add(tree.samples[i]);
      }
    }
    return found.count == this->WantedCount;
  }

  /// The box around the search radius, with a margin for rounding.
  Region boxAround(const Vector& center, double length) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double reach = length / this->Factor * (1.0 + 1e-9);
    Region box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = std::nextafter(center[axis] - reach, -infinity);
      box.upper[axis] = std::nextafter(center[axis] + reach, infinity);
    }
    return box;
  }

  double Factor;
  std::size_t WantedCount;
  double Cosine;
};

/// The weak gap criterion, which also rejects edges that leave the body. One leaves at its end x if
/// - nothing continues behind x: fewer than two positions are in the cone there within twice the
///   edge's length (so the two ends cannot agree);
/// - x is dense by the strong criterion with the half-space as its cone;
/// - the other end is dense by the weak criterion.
/// Edges to a far sample, or to the last of evenly spaced slices, stay.
class RimCriterion
{
public:
  /// Whether an edge is rejected. Symmetric; throws and takes time as GapCriterion::rejects().
  template <class TSample>
  bool rejects(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    const bool isOwnDense = this->Weak.isDense(tree, bounds, own, other);
    const bool isOtherDense = this->Weak.isDense(tree, bounds, other, own);
    return (isOwnDense && isOtherDense) ||
           (isOwnDense && this->leavesAt(tree, bounds, other, own)) ||
           (isOtherDense && this->leavesAt(tree, bounds, own, other));
  }

private:
  template <class TSample>
  bool leavesAt(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& end,
    const TSample& other) const
  {
    return this->Around.isDense(tree, bounds, end, other) &&
           !this->Beyond.isDense(tree, bounds, end, other);
  }

  GapCriterion Weak = GapCriterion::weak();
  GapCriterion Around{ 4.0, 3, 0.0 };
  GapCriterion Beyond = GapCriterion::beyond();
};

} // namespace isopoint
