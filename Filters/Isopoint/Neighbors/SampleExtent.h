// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleExtent_h
#define isopoint_SampleExtent_h

#include "Isopoint/Neighbors/ExtentQuery.h"
#include "Isopoint/Base/Region.h"
#include "Isopoint/Tree/SampleBox.h"
#include "Isopoint/Tree/SampleTree.h"
#include "Isopoint/Base/ConcurrentMemo.h"
#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace isopoint
{

/// The bounding boxes of the samples of nodes that are not split, which can be far smaller than
/// their regions. Each is computed when it is first asked for; from any thread.
template <class TSample>
class UnsplitBounds
{
public:
  explicit UnsplitBounds(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(1), but for the first time O(samples of the node).
  /// @throws std::bad_alloc
  SampleBox<TSample> at(std::size_t nodeIndex)
  {
    return this->Boxes.at(nodeIndex, [&]() { return boxOfSamples(this->Tree, this->Tree.nodes[nodeIndex]); });
  }

private:
  const SampleTree<TSample>& Tree;
  ConcurrentMemo<SampleBox<TSample>> Boxes;
};

/// Looks for the samples ahead of a place, the farthest of them first. Those of a subtree whose
/// region tells that they make no difference are left out.
template <class TSample>
class SampleExtentSearch
{
public:
  SampleExtentSearch(
    const SampleTree<TSample>& tree, UnsplitBounds<TSample>& bounds, const ExtentQuery& query)
    : Tree(tree)
    , Bounds(bounds)
    , Query(query)
  {
  }

  /// Takes in the samples in a box around a place ahead.
  void search(double ahead, double half)
  {
    const Vector center = sum(this->Query.place, ahead, this->Query.direction);
    Region box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = std::max(this->Tree.region.lower[axis], center[axis] - half);
      box.upper[axis] = std::min(this->Tree.region.upper[axis], center[axis] + half);
    }
    this->visit(SampleTree<TSample>::rootNode, box);
  }

  double extent() const { return std::min({ this->Above, this->Below, this->Query.enough }); }
  bool isEnough() const { return this->extent() >= this->Query.enough; }

private:
  static constexpr double leastCosine = 0.7071; // of 45 degrees, but for rounding

  /// @param box what the search's has in common with the node's region
  void visit(std::size_t nodeIndex, const Region& box)
  {
    if (!this->mayMatter(box))
    {
      return;
    }
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (!node.isSplit())
    {
      this->addSamples(nodeIndex);
      return;
    }
    const bool isUpperFirst = this->Query.direction[node.axis] > 0.0;
    for (const bool isUpper : { isUpperFirst, !isUpperFirst })
    {
      Region part = box;
      double& bound = isUpper ? part.lower[node.axis] : part.upper[node.axis];
      bound = isUpper ? std::max(bound, node.plane) : std::min(bound, node.plane);
      this->visit(this->Tree.child(node, isUpper), part);
    }
  }

  /// Whether a sample in a box may stand farther ahead, on a side of the plane, than those found.
  /// Rounding is monotonic: what is computed for a sample does not exceed what is for its box.
  template <class TBox>
  bool mayMatter(const TBox& box) const
  {
    double ahead = 0.0; // the largest, as all that follow
    double height = 0.0;
    double depth = 0.0;
    Vector gap{}; // from the place to the box
    for (int axis = 0; axis < 3; ++axis)
    {
      const double lower = box.lower[axis] - this->Query.place[axis];
      const double upper = box.upper[axis] - this->Query.place[axis];
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
    // Lengths are rounded either way.
    constexpr double slack = 0.999;
    const double least = slack * lengthOf(gap);
    return least <= this->Query.reach && ahead >= leastCosine * least;
  }

  /// Of a node that is not split. Where it has many, they are looked at only as long as one of them
  /// may matter.
  void addSamples(std::size_t nodeIndex)
  {
    constexpr std::size_t many = 64;
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    const std::size_t end = node.isLeaf ? node.begin + 1 : node.end;
    const bool areMany = end - node.begin > many;
    const SampleBox<TSample> box = areMany ? this->Bounds.at(nodeIndex) : SampleBox<TSample>{};
    for (std::size_t i = node.begin; i < end; ++i)
    {
      if (areMany && (i - node.begin) % many == 0 && !this->mayMatter(box))
      {
        return;
      }
      const auto* const position = this->Tree.samples[i].position;
      this->add({ position[0], position[1], position[2] });
    }
  }

  void add(const Vector& position)
  {
    const Vector offset = difference(position, this->Query.place);
    const double height = dot(offset, this->Query.normal);
    const double ahead = dot(offset, this->Query.direction);
    const double length = lengthOf(offset);
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

  const SampleTree<TSample>& Tree;
  UnsplitBounds<TSample>& Bounds;
  const ExtentQuery& Query;
  double Above = 0.0; // how far samples stand ahead on this side of the plane
  double Below = 0.0;
};

/// How far samples stand ahead of a place on both sides of the plane through it that is tangent to
/// the surface: the largest component along the direction that the offset of one has, of those
/// within 45 degrees of it and within reach, on the side where they stand less far; at most what is
/// enough, and 0 where there is none. The same however much of the tree is refined.
/// Complexity: O(log n) where samples are far enough off; where none are, O(log n) and the nodes
/// within reach, and the samples of those not split whose bounding box reaches farther than any
/// sample found.
/// @throws std::bad_alloc
template <class TSample>
double extentOfSamples(
  const SampleTree<TSample>& tree, UnsplitBounds<TSample>& bounds, const ExtentQuery& query)
{
  SampleExtentSearch<TSample> search(tree, bounds, query);
  // Mostly the first few samples will do.
  constexpr double share = 0.2;
  const double beyond = query.reach - query.enough;
  search.search(query.enough + 0.5 * beyond, share * beyond);
  if (!search.isEnough())
  {
    // All that count lie in a ball that touches the place, of 1 / sqrt 2 of the reach.
    search.search(0.707 * query.reach, 0.72 * query.reach);
  }
  return search.extent();
}

/// What answers queries of a tree's samples, as long as it is not changed.
template <class TSample>
SampleExtents extentsOf(const SampleTree<TSample>& tree)
{
  if (tree.isEmpty())
  {
    return [](const ExtentQuery&) { return 0.0; };
  }
  const auto bounds = std::make_shared<UnsplitBounds<TSample>>(tree);
  return [&tree, bounds](const ExtentQuery& query)
  { return extentOfSamples(tree, *bounds, query); };
}

} // namespace isopoint

#endif
