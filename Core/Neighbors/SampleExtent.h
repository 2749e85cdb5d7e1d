// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Region.h"
#include "Core/Base/Vector.h"
#include "Core/Neighbors/NearestSample.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// A query for the support of samples in a direction from a position on a surface; see
/// SampleExtents.
struct ExtentQuery
{
  Vector position;
  Vector normal;    // of the surface there
  Vector direction; // orthogonal to the normal, of length 1
  double enough;    // the largest result of interest, positive
  double reach;     // search radius around the position, at least `enough`, finite
};

/// Samples within 45 degrees of the direction count, as far as rounding permits.
constexpr double minCosineAhead = 0.7071;

/// Bounding boxes of unsplit nodes' samples, which can be far smaller than regions; by node.
using UnsplitBounds = ConcurrentMemo<Region>;

/// Finds the extent of samples in a query's direction, farthest samples first. Skips subtrees whose
/// regions show that they do not extend it.
template <class TSample>
class SampleExtentSearch
{
public:
  SampleExtentSearch(
    const SampleTree<TSample>& tree, UnsplitBounds& bounds, const ExtentQuery& query)
    : Tree(tree)
    , Bounds(bounds)
    , Query(query)
  {
  }

  /// Includes the samples in a cube of side 2 * half, at the distance `ahead` along the direction.
  void search(double ahead, double half)
  {
    const Vector center = this->Query.position + ahead * this->Query.direction;
    Region box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = std::max(this->Tree.region.lower[axis], center[axis] - half);
      box.upper[axis] = std::min(this->Tree.region.upper[axis], center[axis] + half);
    }
    searchRegion(this->Tree, rootNode, box, *this);
  }

  double extent() const { return std::min({ this->Above, this->Below, this->Query.enough }); }
  bool isEnough() const { return this->extent() >= this->Query.enough; }

  // For searchRegion().

  bool mayHold(const Node<TSample>& /*node*/, const Region& box) const
  {
    return this->mayHold(box);
  }

  bool isUpperFirst(const Node<TSample>& node) const
  {
    return this->Query.direction[node.axis] > 0.0;
  }

  static const Region& needed(const Region& box) { return box; }

  /// Includes the samples of an unsplit node; checks at times whether the rest can matter.
  bool add(std::size_t nodeIndex)
  {
    constexpr std::size_t many = 64;
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    const std::size_t end = node.positionsEnd();
    const bool areMany = end - node.begin > many;
    const Region box =
      areMany ? this->Bounds.at(nodeIndex, [&]() { return boxOfSamples(this->Tree, node); })
              : everywhere;
    for (std::size_t i = node.begin; i < end; ++i)
    {
      if (areMany && (i - node.begin) % many == 0 && !this->mayHold(box))
      {
        break;
      }
      this->include(positionOf(this->Tree.samples[i]));
    }
    return false;
  }

private:
  /// Whether a sample in a box may extend farther than those found on its side of the plane.
  /// Rounding is monotonic, so no value computed for a sample exceeds that for its box.
  bool mayHold(const Region& box) const
  {
    double ahead = 0.0; // upper bounds, as are the next two
    double height = 0.0;
    double depth = 0.0;
    Vector gap{}; // from the position to the box
    for (int axis = 0; axis < 3; ++axis)
    {
      const double lower = box.lower[axis] - this->Query.position[axis];
      const double upper = box.upper[axis] - this->Query.position[axis];
      if (!(lower <= upper))
      {
        return false;
      }
      gap[axis] = std::max({ lower, -upper, 0.0 });
      const double direction = this->Query.direction[axis];
      const double normal = this->Query.normal[axis];
      ahead += std::max(direction * lower, direction * upper);
      height += std::max(normal * lower, normal * upper);
      depth += std::max(-normal * lower, -normal * upper);
    }
    const double useful = std::min(ahead, this->Query.enough);
    if (!(height >= 0.0 && useful > this->Above) && !(depth >= 0.0 && useful > this->Below))
    {
      return false;
    }
    // Lengths may be rounded down or up.
    constexpr double slack = 0.999;
    const double least = slack * lengthOf(gap);
    return least <= this->Query.reach && ahead >= minCosineAhead * least;
  }

  void include(const Vector& position)
  {
    const Vector offset = position - this->Query.position;
    const double height = dot(offset, this->Query.normal);
    const double ahead = dot(offset, this->Query.direction);
    if (!this->isOfUse(height, ahead))
    {
      return; // avoids the length, which takes far longer to compute
    }
    const double length = lengthOf(offset);
    if (ahead < minCosineAhead * length || length > this->Query.reach)
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

  /// Whether a sample extends farther than those found on its side of the plane.
  bool isOfUse(double height, double ahead) const
  {
    return (height >= 0.0 && ahead > this->Above) || (height <= 0.0 && ahead > this->Below);
  }

  const SampleTree<TSample>& Tree;
  UnsplitBounds& Bounds;
  const ExtentQuery& Query;
  double Above = 0.0; // extent of the samples on this side of the plane
  double Below = 0.0;
};

/// The NearestSampleSearch condition that a sample extends to ExtentQuery::enough or more.
class IsAhead
{
public:
  explicit IsAhead(const ExtentQuery& query)
    : Query(query)
  {
  }

  bool mayHoldIn(const Region& region) const
  {
    double ahead = 0.0; // upper bound
    for (int axis = 0; axis < 3; ++axis)
    {
      const double direction = this->Query.direction[axis];
      const double position = this->Query.position[axis];
      ahead += std::max(
        direction * (region.lower[axis] - position), direction * (region.upper[axis] - position));
    }
    constexpr double slack = 0.999; // for rounding
    return ahead >= slack * this->Query.enough;
  }

  bool holdsAt(const Vector& offset, double length) const
  {
    const double ahead = dot(offset, this->Query.direction);
    return ahead >= this->Query.enough && ahead >= minCosineAhead * length;
  }

private:
  const ExtentQuery& Query;
};

/// The extents of a tree's samples around positions on a surface. The tree must not change
/// meanwhile.
template <class TSample>
class SampleExtents
{
public:
  explicit SampleExtents(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// How far samples extend from a position in direction D. On each side of the tangent plane: the
  /// largest component along D of the offsets to samples within 45 degrees of D and the search
  /// radius, 0 without samples. The result is the smaller of both sides, at most query.enough.
  /// Independent of tree refinement. Thread-safe.
  /// Complexity: O(log n) if samples extend far enough; else O(log n + nodes within the search
  /// radius + samples of unsplit nodes whose bounding box extends farther than the samples found)
  /// @throws std::bad_alloc; MissingNode at a node whose samples another rank holds
  double at(const ExtentQuery& query) const
  {
    if (this->Tree.isEmpty())
    {
      return 0.0;
    }
    SampleExtentSearch<TSample> search(this->Tree, this->Bounds, query);
    // Mostly the first few samples suffice.
    constexpr double share = 0.2;
    const double beyond = query.reach - query.enough;
    search.search(query.enough + 0.5 * beyond, share * beyond);
    if (!search.isEnough())
    {
      // All samples that count lie in a ball of radius reach / sqrt 2 that touches the position.
      search.search(0.707 * query.reach, 0.72 * query.reach);
    }
    return search.extent();
  }

  /// The nearest sample that extends to query.enough or more; see NearestSampleSearch.
  /// @throws MissingNode
  const TSample* nearest(const ExtentQuery& query) const
  {
    return NearestSampleSearch<TSample, IsAhead>(
      this->Tree, query.position, query.reach, IsAhead(query))
      .search();
  }

  /// The nearest sample to a position, within a search radius; see NearestSampleSearch.
  /// @throws MissingNode
  const TSample* nearestTo(const Vector& position, double reach) const
  {
    return NearestSampleSearch<TSample>(this->Tree, position, reach).search();
  }

private:
  const SampleTree<TSample>& Tree;
  mutable UnsplitBounds Bounds; // thread-safe
};

} // namespace isopoint
