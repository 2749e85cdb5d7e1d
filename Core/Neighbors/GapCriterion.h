// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_GapCriterion_h
#define isopoint_GapCriterion_h

#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Neighbors/NeighborSearch.h"
#include "Core/Tree/SampleBounds.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{

/// Drops edges across gaps in the cloud. The spacing behind the end x of an edge {x, y} is the
/// distance from x to the 2nd nearest position of a sample within 54.7356 degrees of the direction
/// from y to x (the angle's cosine is 1 / sqrt 3), infinite where there are fewer. An edge is
/// dropped if it is longer than `factor` times the larger one of the spacings behind its ends.
/// - All samples count, in N(x) or not: the cells at the border of a void extend across it, and so
///   do not touch those of the nearest samples.
/// - Only samples behind x count, since on lines and in slices samples stand much closer to each
///   other than to those of the next line or slice.
/// - Both ends must agree, so that edges from a dense region to a sparse one stay.
class GapCriterion
{
public:
  /// The cosine of the largest angle at which samples are behind an end: 1 / sqrt 3
  static constexpr double coneCosine = 1.0 / 1.7320508075688772;

  /// @param factor positive
  /// @param count of samples behind an end, the farthest of which has the spacing: 1 to 3
  /// @param cosine of the largest angle, 0 for all of the half-space behind an end
  GapCriterion(double factor, std::size_t count, double cosine = coneCosine)
    : Factor(factor)
    , WantedCount(count)
    , Cosine(cosine)
  {
  }

  /// What is connected with a gap is in it if it is over this one.
  static GapCriterion weak() { return { 2.0, 2 }; }

  /// What is over this one is in a gap. Next to no edge of random samples without a gap is.
  /// @param ratio of the edge's length to that of its part which spans the gap, 1 or more
  static GapCriterion strong(double ratio = 1.0) { return { 4.0 * ratio, 3 }; }

  /// Whether the edge between the positions of two samples is dropped. Symmetric in them, and the
  /// same whatever part of the tree is built.
  /// @param bounds of the tree's samples, computed where many nodes are looked at
  /// @throws MissingNode at a node whose samples another rank holds
  /// Complexity: O(depth + nodes whose samples, or of a partial tree regions, may be in the cones
  /// behind both ends, up to the edge's length / factor)
  template <class TSample>
  bool drops(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    return this->isCrowded(tree, bounds, own, other) && this->isCrowded(tree, bounds, other, own);
  }

  /// Whether the edge is longer than `factor` times the spacing behind its end. See drops().
  template <class TSample>
  bool isCrowded(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& end,
    const TSample& other) const
  {
    const Vector center = positionOf(end);
    Behind<TSample> behind{ tree, bounds, center, offsetBetween(center, positionOf(other)), {} };
    // The smallest node around all that may count.
    const Region box = this->boxAround(center, behind.edge.length);
    std::size_t nodeIndex = SampleTree<TSample>::rootNode;
    Region region = tree.region;
    for (;;)
    {
      const Node<TSample>& node = tree.nodes[nodeIndex];
      const bool isUpper = node.isSplit() && box.lower[node.axis] > node.plane;
      if (!isUpper && !(node.isSplit() && box.upper[node.axis] < node.plane))
      {
        return this->findBehind(nodeIndex, region, behind);
      }
      (isUpper ? region.lower : region.upper)[node.axis] = node.plane;
      nodeIndex = tree.child(node, isUpper);
    }
  }

  /// Whether edges at the sample of a leaf may be dropped that are no longer than this: a quick
  /// look, whatever their direction. False without any.
  template <class TSample>
  bool mayDrop(
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
  static constexpr std::size_t mostWanted = 3;

  /// The positions found so far behind an end, each once.
  template <class TSample>
  struct Found
  {
    std::array<const TSample*, mostWanted> samples;
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

  /// The samples behind an end of an edge.
  template <class TSample>
  struct Behind
  {
    const SampleTree<TSample>& tree;
    SampleBounds<TSample>& bounds;
    Vector center; // the end
    Offset edge;   // to the other end
    Found<TSample> found;
    std::size_t visited = 0; // nodes
  };

  /// Adds samples behind an end. @returns whether there are enough
  template <class TSample>
  bool findBehind(std::size_t nodeIndex, const Region& region, Behind<TSample>& behind) const
  {
    if (!this->mayHoldAny(offsetsToBox(behind.center, region.lower, region.upper), behind))
    {
      return false;
    }
    const SampleTree<TSample>& tree = behind.tree;
    const Node<TSample>& node = tree.nodes[nodeIndex];
    if (node.isSplit())
    {
      // Mostly regions suffice; those of samples on lines and sheets reach far beyond these.
      constexpr std::size_t many = 256;
      if (++behind.visited > many && !tree.isPartial)
      {
        behind.bounds.compute();
        if (!this->mayHoldAny(behind.bounds.offsets(behind.center, node), behind))
        {
          return false;
        }
      }
      const bool isUpperFirst = behind.center[node.axis] > node.plane;
      for (const bool isUpper : { isUpperFirst, !isUpperFirst })
      {
        Region part = region;
        (isUpper ? part.lower : part.upper)[node.axis] = node.plane;
        if (this->findBehind(tree.child(node, isUpper), part, behind))
        {
          return true;
        }
      }
      return false;
    }
    if (node.isAbsent)
    {
      throw MissingNode{ nodeIndex, this->boxAround(behind.center, behind.edge.length) };
    }
    return this->add(
      tree, nodeIndex,
      [&](const TSample& sample)
      {
        const Offset offset = offsetBetween(behind.center, positionOf(sample));
        return this->Factor * offset.length < behind.edge.length &&
               -dot(offset.vector, behind.edge.vector) >
                 this->Cosine * (offset.length * behind.edge.length);
      },
      behind.found);
  }

  /// Whether a sample with an offset within bounds may be behind an end. Rounding is monotonic: no
  /// number computed for a sample exceeds its bound.
  template <class TSample>
  bool mayHoldAny(const OffsetBounds& offsets, const Behind<TSample>& behind) const
  {
    const double least = std::sqrt(offsets.leastSquaredLength);
    return this->Factor * least < behind.edge.length &&
           -leastProduct(behind.edge, offsets) > this->Cosine * (least * behind.edge.length);
  }

  /// Adds the samples of an unsplit node that are wanted. @returns whether there are enough
  template <class TSample, class Kind>
  bool add(const SampleTree<TSample>& tree, std::size_t nodeIndex, const Kind& isWanted,
    Found<TSample>& found) const
  {
    const Node<TSample>& node = tree.nodes[nodeIndex];
    const std::size_t end = node.isLeaf ? node.begin + std::size_t{ 1 } : node.end;
    for (std::size_t i = node.begin; i < end && found.count < this->WantedCount; ++i)
    {
      if (isWanted(tree.samples[i]))
      {
        found.add(tree.samples[i]);
      }
    }
    return found.count == this->WantedCount;
  }

  /// A box that holds all that is close enough to matter, with room for rounding.
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

/// The weak gap criterion, and edges that leave the body. An edge leaves it at the end x if
/// - nothing goes on behind x: fewer than two positions lie in the cone there within twice the
///   edge's length. So both ends of the edge cannot agree;
/// - samples stand close around x: the edge is over the strong criterion there, with all of the
///   half-space for the cone;
/// - the edge is over the weak criterion at its other end.
/// So edges to a far sample, or to the last of slices that are evenly apart, stay.
class RimCriterion
{
public:
  /// As GapCriterion::drops().
  template <class TSample>
  bool drops(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& own,
    const TSample& other) const
  {
    const bool isOwnCrowded = this->Weak.isCrowded(tree, bounds, own, other);
    const bool isOtherCrowded = this->Weak.isCrowded(tree, bounds, other, own);
    return (isOwnCrowded && isOtherCrowded) ||
           (isOwnCrowded && this->leavesAt(tree, bounds, other, own)) ||
           (isOtherCrowded && this->leavesAt(tree, bounds, own, other));
  }

private:
  template <class TSample>
  bool leavesAt(const SampleTree<TSample>& tree, SampleBounds<TSample>& bounds, const TSample& end,
    const TSample& other) const
  {
    return this->Around.isCrowded(tree, bounds, end, other) &&
           !this->Beyond.isCrowded(tree, bounds, end, other);
  }

  GapCriterion Weak = GapCriterion::weak();
  GapCriterion Around{ 4.0, 3, 0.0 };
  GapCriterion Beyond{ 0.5, 2 };
};

} // namespace isopoint

#endif
