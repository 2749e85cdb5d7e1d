// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Region.h"
#include "Core/Tetrahedra/PartialTriangulation.h"
#include "Core/Tetrahedra/SphereFunction.h"
#include "Core/Tree/NodeMarks.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/TreeRefinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace isopoint
{

/// The NodeMarks used to find crossing tetrahedra.
namespace nodemarks
{

/// The samples of this leaf are a vertex.
inline constexpr std::uint8_t inserted = 1;

/// A search has reached this leaf or small unsplit node: a crossing cell's sphere may meet its
/// region.
inline constexpr std::uint8_t reached = 2;

/// A search has skipped this node: such a sphere may meet its region, but holds none of its
/// samples.
inline constexpr std::uint8_t missed = 4;

} // namespace nodemarks

/// The ball of a tetrahedron, with lower bounds of its function over boxes.
class BallShape
{
public:
  explicit BallShape(const TetrahedronCorners& corners)
    : Ball(ballAround(corners))
  {
  }

  /// Lower bounds over a box, by axis.
  using Bounds = Vector;

  /// Updates the bounds for the extent of a box along an axis.
  void narrow(Bounds& bounds, int axis, double lower, double upper) const
  {
    bounds[axis] = this->Ball.least(axis, lower, upper);
  }

  /// Whether a box may intersect the ball.
  bool mayHold(const Bounds& bounds) const { return !SphereFunction::isPositive(bounds); }

  bool isAbove(int axis, double coordinate) const { return this->Ball.isAbove(axis, coordinate); }
  Side sideOf(const Vector& position) const { return this->Ball.sideOf(position); }

  /// Any sample inside will do.
  static constexpr bool isBestWanted = false;
  static bool isBetter(const Vector& /*position*/) { return true; }
  static void setBest(const Vector& /*position*/) {}

private:
  SphereFunction Ball;
};

/// The shape for a facet of the hull: the half-space beyond its plane and, in the plane, its
/// circle. Most samples in the plane of a flat hull lie outside the circle.
class HullFacetShape
{
public:
  explicit HullFacetShape(const HullFacetCorners& corners)
    : Beyond(halfSpaceBeyond(corners))
    , Ball(ballThrough(corners))
  {
  }

  struct Bounds
  {
    Vector beyond;
    Vector ball;
  };

  void narrow(Bounds& bounds, int axis, double lower, double upper) const
  {
    bounds.beyond[axis] = this->Beyond.least(axis, lower, upper);
    bounds.ball[axis] = this->Ball.least(axis, lower, upper);
  }

  bool mayHold(const Bounds& bounds) const
  {
    return !SphereFunction::isPositive(bounds.beyond) && this->isFarther(bounds.beyond) &&
           !(SphereFunction::isNotNegative(bounds.beyond) &&
             SphereFunction::isPositive(bounds.ball));
  }

  bool isAbove(int axis, double coordinate) const { return this->Beyond.isAbove(axis, coordinate); }
  Side sideOf(const Vector& position) const { return this->Beyond.sideOf(position); }

  /// The farthest sample beyond the plane is on the hull of all samples.
  static constexpr bool isBestWanted = true;
  bool isBetter(const Vector& position) const
  {
    return this->isFarther(this->Beyond.leastIn({ position, position }));
  }

  /// From now on, boxes that are not farther than the position are as if not intersected.
  void setBest(const Vector& position)
  {
    this->Farthest = SphereFunction::sum(this->Beyond.leastIn({ position, position }));
  }

private:
  bool isFarther(const Vector& beyond) const
  {
    return SphereFunction::sum(beyond) < this->Farthest;
  }

  double Farthest = HUGE_VAL;
  SphereFunction Beyond;
  SphereFunction Ball;
};

/// Nodes with at most this many samples are searched without being split.
constexpr std::size_t fewSamples = 16;

/// Finds a sample inside the sphere of a tetrahedron, mostly one near the center, or the sample
/// farthest beyond a facet of the hull. In a process group, searches only this rank's samples.
/// Reuses memory. For one thread.
template <class TSample>
class SphereSearch
{
public:
  /// @param boxes of the samples of some nodes, by index; computed on demand
  /// @param isHullWanted whether many cells are on the hull of all samples: then boxes pay at once
  SphereSearch(const SampleTree<TSample>& tree, const PartialTriangulation& triangulation,
    NodeMarks& marks, ConcurrentMemo<Region>& boxes, bool isHullWanted)
    : Tree(tree)
    , Triangulation(triangulation)
    , Marks(marks)
    , Boxes(boxes)
    , ManyVisits(isHullWanted ? 0 : 250)
    , ManySamples(isHullWanted ? tree.samples.size() : smallNode)
  {
  }

  /// Finds a sample for a cell, as above, that is not inserted yet. Sets the marks above.
  /// @returns its leaf. Nothing means that there is none if isComplete()
  std::optional<std::size_t> find(CellHandle cell)
  {
    this->Cell = cell;
    this->UnsplitReached = 0;
    this->Begin = this->Visits;
    return this->Triangulation.isBeyondHull(cell)
             ? this->findIn(HullFacetShape(this->Triangulation.hullFacetOf(cell)))
             : this->findIn(BallShape(this->Triangulation.tetrahedronOf(cell)));
  }

  /// Whether the last search, if it found nothing, saw all samples.
  bool isComplete() const { return this->UnsplitReached == 0; }

  /// Nodes to split so that searches see all samples, with repetitions.
  const std::vector<std::size_t>& unsplit() const { return this->Unsplit; }

  /// The number of nodes visited so far, or equal work.
  std::size_t visits() const { return this->Visits; }

private:
  template <class TShape>
  std::optional<std::size_t> findIn(TShape shape)
  {
    this->Found.reset();
    Region box = this->Tree.region;
    const typename TShape::Bounds bounds = boundsIn(shape, box);
    if (shape.mayHold(bounds))
    {
      this->visit(rootNode, shape, bounds, box);
    }
    return this->Found;
  }

  template <class TShape>
  static typename TShape::Bounds boundsIn(const TShape& shape, const Region& box)
  {
    typename TShape::Bounds bounds{};
    for (int axis = 0; axis < 3; ++axis)
    {
      shape.narrow(bounds, axis, box.lower[axis], box.upper[axis]);
    }
    return bounds;
  }

  /// @param bounds of the node's region
  /// @param box the node's region; restored on return
  /// @returns whether the search is finished
  template <class TShape>
  bool visit(
    std::size_t nodeIndex, TShape& shape, const typename TShape::Bounds& bounds, Region& box)
  {
    ++this->Visits;
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (!this->Tree.hasOwn(node))
    {
      return false;
    }
    if (!node.isSplit())
    {
      return this->visitEnd(nodeIndex, shape);
    }
    if (this->isLong() && !this->mayReachSamples(nodeIndex, shape))
    {
      this->Marks.set(nodeIndex, nodemarks::missed);
      return false;
    }
    const bool isUpperFirst = shape.isAbove(node.axis, node.plane);
    // The bounds of the nearer child are those of the node.
    return this->visitChild(node, isUpperFirst, shape, bounds, box) ||
           this->visitFarther(node, !isUpperFirst, shape, bounds, box);
  }

  template <class TShape>
  bool visitFarther(const Node<TSample>& node, bool isUpper, TShape& shape,
    typename TShape::Bounds bounds, Region& box)
  {
    const int axis = node.axis;
    shape.narrow(
      bounds, axis, isUpper ? node.plane : box.lower[axis], isUpper ? box.upper[axis] : node.plane);
    return shape.mayHold(bounds) && this->visitChild(node, isUpper, shape, bounds, box);
  }

  template <class TShape>
  bool visitChild(const Node<TSample>& node, bool isUpper, TShape& shape,
    const typename TShape::Bounds& bounds, Region& box)
  {
    double& bound = isUpper ? box.lower[node.axis] : box.upper[node.axis];
    const double former = bound;
    bound = node.plane;
    const bool isDone = this->visit(this->Tree.child(node, isUpper), shape, bounds, box);
    bound = former;
    return isDone;
  }

  /// Whether the search visits so many nodes that bounding boxes of samples are worth their cost,
  /// as in the huge sphere of a sliver on the hull, which passes between the hull and the samples.
  bool isLong() const { return this->Visits - this->Begin > this->ManyVisits; }

  /// Whether the shape may hold a sample of a node, as far as their bounding box tells, or, of few
  /// samples, their positions. Large nodes always pass, since their boxes are costly.
  template <class TShape>
  bool mayReachSamples(std::size_t nodeIndex, const TShape& shape)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (node.count() > this->ManySamples || !this->Tree.hasOnlyOwn(node))
    {
      return true;
    }
    if (node.count() <= fewSamples)
    {
      const TSample* const samples = this->Tree.samples.data();
      return std::any_of(samples + node.begin, samples + node.end,
        [&](const TSample& sample) { return shape.sideOf(positionOf(sample)) != Side::Outside; });
    }
    return shape.mayHold(
      boundsIn(shape, this->Boxes.at(nodeIndex, [&]() { return boxOfSamples(this->Tree, node); })));
  }

  /// Visits the samples of a node without children.
  template <class TShape>
  bool visitEnd(std::size_t nodeIndex, TShape& shape)
  {
    const Node<TSample>& node = this->Tree.nodes[nodeIndex];
    if (node.isLeaf)
    {
      this->Marks.set(nodeIndex, nodemarks::reached);
      if (this->Marks.has(nodeIndex, nodemarks::inserted) || !this->isInside(shape, node.begin))
      {
        return false;
      }
      this->Found = nodeIndex;
      shape.setBest(positionOf(this->Tree.samples[node.begin]));
      return !TShape::isBestWanted;
    }
    constexpr std::size_t manyUnsplit = 64;
    bool hasToBeSplit = node.count() > fewSamples;
    for (std::size_t i = node.begin; i < node.end && !hasToBeSplit; ++i)
    {
      ++this->Visits;
      hasToBeSplit = shape.sideOf(positionOf(this->Tree.samples[i])) != Side::Outside;
    }
    if (hasToBeSplit)
    {
      this->Unsplit.push_back(nodeIndex); // the search is repeated, and then sets marks below
      ++this->UnsplitReached;
    }
    else
    {
      this->Marks.set(nodeIndex, nodemarks::reached);
    }
    return this->UnsplitReached >= manyUnsplit;
  }

  template <class TShape>
  bool isInside(const TShape& shape, std::size_t sample)
  {
    const Vector position = positionOf(this->Tree.samples[sample]);
    if (!shape.isBetter(position))
    {
      return false;
    }
    const Side side = shape.sideOf(position);
    if (side == Side::Unknown)
    {
      constexpr std::size_t visitsForExact = 50;
      this->Visits += visitsForExact;
      return this->Triangulation.isInside(this->Cell, position);
    }
    return side == Side::Inside;
  }

  const SampleTree<TSample>& Tree;
  const PartialTriangulation& Triangulation;
  NodeMarks& Marks;
  ConcurrentMemo<Region>& Boxes;
  const std::size_t ManyVisits;
  const std::size_t ManySamples;
  CellHandle Cell = nullptr;
  std::optional<std::size_t> Found;
  std::size_t Visits = 0;
  std::size_t Begin = 0; // visits before this search
  std::size_t UnsplitReached = 0;
  std::vector<std::size_t> Unsplit;
};

} // namespace isopoint
