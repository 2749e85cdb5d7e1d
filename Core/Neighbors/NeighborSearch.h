// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NeighborSearch_h
#define isopoint_NeighborSearch_h

#include "Core/Base/Region.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// A node met in a search.
struct FoundNode
{
  std::size_t nodeIndex;
  int depth;
};

/// @throws MissingNode if a node that is not split is no leaf
template <class TSample>
void requireLeaf(const SampleTree<TSample>& tree, std::size_t nodeIndex, const Region& box)
{
  if (!tree.nodes[nodeIndex].isLeaf || tree.nodes[nodeIndex].isAbsent)
  {
    throw MissingNode{ nodeIndex, box };
  }
}

/// Visits, in the subtree at `top`, the nodes of the depth `nodeDepth`, and those above it that are
/// not split, whose regions touch the given one. That of `top` must touch it: then each splitting
/// plane takes a single comparison.
/// @param enter(node) whether the node and its descendants are of interest
/// @param visit(nodeIndex) returns whether to end the search
/// @returns whether a visit did
/// @throws MissingNode at a node above that depth whose samples another rank holds
template <class TSample, class Filter, class Visitor>
bool visitTouchingInSubtree(const SampleTree<TSample>& tree, FoundNode top, int nodeDepth,
  const Region& region, const Filter& enter, const Visitor& visit)
{
  FoundNode stack[maximumDepth + 2];
  int stackSize = 0;
  stack[stackSize++] = top;
  while (stackSize > 0)
  {
    const FoundNode found = stack[--stackSize];
    const Node<TSample>& node = tree.nodes[found.nodeIndex];
    if (!enter(node))
    {
      continue;
    }
    if (found.depth == nodeDepth || !node.isSplit())
    {
      if (node.isAbsent && found.depth < nodeDepth)
      {
        throw MissingNode{ found.nodeIndex, region };
      }
      if (visit(found.nodeIndex))
      {
        return true;
      }
      continue;
    }
    // Both children are written and the stack grows by those that touch, without a branch: which
    // ones do is unpredictable.
    stack[stackSize] = { node.upperNode(), found.depth + 1 };
    stackSize += node.plane <= region.upper[node.axis] ? 1 : 0;
    stack[stackSize] = { node.lowerNode(), found.depth + 1 };
    stackSize += node.plane >= region.lower[node.axis] ? 1 : 0;
  }
  return false;
}

/// Where the nodes are that touch a node: the roots of the subtrees that hold all nodes whose
/// closed region shares a point with the closed region of the path's node. Each lies across a plane
/// that bounds the node's region: the splitting plane of an ancestor. The nearest ancestor that
/// splits an axis with the node on a side bounds the region there, and so does every farther one
/// whose plane has the same coordinate, as in lattices: the search crosses them all.
class Surroundings
{
public:
  /// Implicit: a path stands for what surrounds its node.
  Surroundings(const Path& path)
    : region(path.region)
  {
    // Each is written, and counts if it belongs to them, without a branch: that is unpredictable.
    for (int depth = path.depth; depth > 0; --depth)
    {
      const bool upper = path.uppers[depth - 1];
      const int axis = path.axes[depth - 1];
      const double bound = upper ? path.region.lower[axis] : path.region.upper[axis];
      this->Roots[this->Count] = { siblingOf(path.nodeIndices[depth]), depth };
      this->Count += bound == path.planes[depth - 1] ? 1 : 0;
    }
  }

  /// The roots, the nearest first.
  const FoundNode* begin() const { return this->Roots; }
  const FoundNode* end() const { return this->Roots + this->Count; }

  const Region region; // of the path's node

private:
  FoundNode Roots[maximumDepth];
  int Count = 0;
};

/// Visits all nodes of the depth `nodeDepth`, and those above it that are not split, other than the
/// surrounded one, whose closed region shares a point with its closed region (the neighborhood
/// N(c) of [RL06] section 5).
/// @param enter(node) whether a node and its descendants are of interest
/// @param visit(nodeIndex) returns whether to end the search
/// @returns whether a visit did
/// Complexity: O(depth + nodes visited); 14.5 neighbors on average in a uniform cloud.
template <class TSample, class Filter, class Visitor>
bool visitTouching(const SampleTree<TSample>& tree, const Surroundings& surroundings, int nodeDepth,
  const Filter& enter, const Visitor& visit)
{
  return std::any_of(surroundings.begin(), surroundings.end(),
    [&](FoundNode root)
    { return visitTouchingInSubtree(tree, root, nodeDepth, surroundings.region, enter, visit); });
}

/// The same with every node of interest.
template <class TSample, class Visitor>
bool visitTouching(const SampleTree<TSample>& tree, const Surroundings& surroundings, int nodeDepth,
  const Visitor& visit)
{
  const auto enterAll = [](const Node<TSample>&) { return true; };
  return visitTouching(tree, surroundings, nodeDepth, enterAll, visit);
}

/// Visits the neighbors of a leaf, around which the tree has to be split down to leaves.
/// @param visit(nodeIndex) returns whether to end the search
/// @returns whether a visit did
/// @throws MissingNode where it is not, as may be where ranks share it
template <class TSample, class Visitor>
bool visitNeighbors(
  const SampleTree<TSample>& tree, const Surroundings& surroundings, const Visitor& visit)
{
  return visitTouching(tree, surroundings, maximumDepth,
    [&](std::size_t nodeIndex)
    {
      requireLeaf(tree, nodeIndex, surroundings.region);
      return visit(nodeIndex);
    });
}

/// The neighbors of a leaf as far as they are known or else, in `memory`, searched for; none if
/// they are more than `most`.
template <class TSample>
NodeList<typename TSample::Id> fewNeighborsOf(const SampleTree<TSample>& tree,
  const NeighborhoodCache<typename TSample::Id>& known, std::size_t leaf, std::size_t most,
  std::vector<typename TSample::Id>& memory)
{
  using List = NodeList<typename TSample::Id>;
  const List list = known.at(leaf);
  if (!list.isEmpty())
  {
    return list.count <= most ? list : List{};
  }
  memory.clear();
  const bool areMany = visitNeighbors(tree, pathToLeaf(tree, leaf),
    [&](std::size_t neighbor)
    {
      memory.push_back(static_cast<typename TSample::Id>(neighbor));
      return memory.size() > most;
    });
  return areMany ? List{} : List{ memory.data(), memory.size() };
}

/// Visits the nodes, other than the path's own, that are not split and touch a box that touches the
/// path's region; a few that do not touch it may be among them. Only the planes that the box
/// reaches are crossed.
/// @param visit(nodeIndex) returns whether to end the search
/// @returns whether a visit did
template <class TSample, class Visitor>
bool visitAround(
  const SampleTree<TSample>& tree, const Path& path, const Region& box, const Visitor& visit)
{
  const auto enterAll = [](const Node<TSample>&) { return true; };
  for (int depth = path.depth; depth > 0; --depth)
  {
    const double plane = path.planes[depth - 1];
    const int axis = path.axes[depth - 1];
    const bool reaches =
      path.uppers[depth - 1] ? box.lower[axis] <= plane : box.upper[axis] >= plane;
    if (reaches && visitTouchingInSubtree(tree, { siblingOf(path.nodeIndices[depth]), depth },
                     maximumDepth, box, enterAll, visit))
    {
      return true;
    }
  }
  return false;
}

/// Whether samples of a node may lie on the other side of the isovalue.
/// @param isBelow the side in question: below the isovalue, or not
template <class TSample>
bool mayHoldOtherSide(const Node<TSample>& node, double isovalue, bool isBelow)
{
  return isBelow ? node.maximum >= isovalue : node.minimum < isovalue;
}

/// Whether a node that touches the surrounded one has samples on the other side of the isovalue.
/// Value ranges prune the search, so that it is short where there is none.
/// @param isBelow the side of the surrounded node: below the isovalue, or not
template <class TSample>
bool touchesOtherSide(const SampleTree<TSample>& tree, const Surroundings& surroundings,
  int nodeDepth, double isovalue, bool isBelow)
{
  return visitTouching(
    tree, surroundings, nodeDepth,
    [isovalue, isBelow](const Node<TSample>& node)
    { return mayHoldOtherSide(node, isovalue, isBelow); },
    [](std::size_t) { return true; });
}

} // namespace isopoint

#endif
