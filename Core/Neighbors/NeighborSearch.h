// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// A node in a search.
struct FoundNode
{
  std::size_t nodeIndex;
  int depth;
};

/// @throws MissingNode if an unsplit node is not a leaf, or its samples are absent
template <class TSample>
void requireLeaf(const SampleTree<TSample>& tree, std::size_t nodeIndex, const Region& box)
{
  if (!tree.nodes[nodeIndex].isLeaf || tree.nodes[nodeIndex].isAbsent)
  {
    throw MissingNode{ nodeIndex, box };
  }
}

/// Visits the nodes below `top` at depth `nodeDepth`, and unsplit ones above it, whose regions
/// touch the given one. That of `top` must touch it: then each plane takes one comparison.
/// @param enter(node) whether the node or its descendants are of interest
/// @param visit(nodeIndex) returns true to end the search; then the function returns true
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
      if (found.depth < nodeDepth)
      {
        requireSamples(tree, found.nodeIndex, [&region]() { return region; });
      }
      if (visit(found.nodeIndex))
      {
        return true;
      }
      continue;
    }
    // Write both children and count those that touch: a branch would be unpredictable.
    stack[stackSize] = { node.upperNode(), found.depth + 1 };
    stackSize += node.plane <= region.upper[node.axis] ? 1 : 0;
    stack[stackSize] = { node.lowerNode(), found.depth + 1 };
    stackSize += node.plane >= region.lower[node.axis] ? 1 : 0;
  }
  return false;
}

/// The roots of the subtrees that hold all nodes whose closed regions share a point with that of
/// the path's node. Each is across a bounding plane of the region: that of the nearest ancestor
/// that cuts the axis on this side, and of farther ones at the same coordinate, as in lattices.
class TouchingRoots
{
public:
  /// Implicit: a path stands for the surroundings of its node.
  TouchingRoots(const Path& path)
    : region(path.region)
  {
    // Write each root and count those across a bounding plane: a branch would be unpredictable.
    for (int depth = path.depth; depth > 0; --depth)
    {
      const bool upper = path.uppers[depth - 1];
      const int axis = path.axes[depth - 1];
      const double bound = upper ? path.region.lower[axis] : path.region.upper[axis];
      this->Roots[this->Count] = { siblingOf(path.nodeIndices[depth]), depth };
      this->Count += bound == path.planes[depth - 1] ? 1 : 0;
    }
  }

  /// The roots, nearest first.
  const FoundNode* begin() const { return this->Roots; }
  const FoundNode* end() const { return this->Roots + this->Count; }

  const Region region; // of the path's node

private:
  FoundNode Roots[maximumDepth];
  int Count = 0;
};

/// Visits all nodes at depth `nodeDepth`, and unsplit ones above it, whose closed regions share a
/// point with that of the surrounded node: its neighborhood N(c) without itself ([RL06] section 5).
/// @param enter, visit see visitTouchingInSubtree()
/// Complexity: O(depth + nodes visited); 14.5 neighbors on average in a uniform cloud
template <class TSample, class Filter, class Visitor>
bool visitTouching(const SampleTree<TSample>& tree, const TouchingRoots& surroundings,
  int nodeDepth, const Filter& enter, const Visitor& visit)
{
  return std::any_of(surroundings.begin(), surroundings.end(),
    [&](FoundNode root)
    { return visitTouchingInSubtree(tree, root, nodeDepth, surroundings.region, enter, visit); });
}

template <class TSample, class Visitor>
bool visitTouching(const SampleTree<TSample>& tree, const TouchingRoots& surroundings,
  int nodeDepth, const Visitor& visit)
{
  const auto enterAll = [](const Node<TSample>&) { return true; };
  return visitTouching(tree, surroundings, nodeDepth, enterAll, visit);
}

/// Visits the neighbors of a leaf. The tree must be split down to leaves around it.
/// @param visit see visitTouchingInSubtree()
/// @throws MissingNode where the tree is not split, as on one of several ranks
template <class TSample, class Visitor>
bool visitNeighbors(
  const SampleTree<TSample>& tree, const TouchingRoots& surroundings, const Visitor& visit)
{
  return visitTouching(tree, surroundings, maximumDepth,
    [&](std::size_t nodeIndex)
    {
      requireLeaf(tree, nodeIndex, surroundings.region);
      return visit(nodeIndex);
    });
}

/// The neighbors of a leaf, from `known` or from a search, which lists them in `memory`; an empty
/// list if there are more than `most`.
template <class TSample>
IndexSpan<typename TSample::Id> fewNeighborsOf(const SampleTree<TSample>& tree,
  const NeighborhoodCache<typename TSample::Id>& known, std::size_t leaf, std::size_t most,
  std::vector<typename TSample::Id>& memory)
{
  using List = IndexSpan<typename TSample::Id>;
  const List list = known.at(leaf);
  if (!list.isEmpty())
  {
    return list.count <= most ? list : List{};
  }
  memory.clear();
  const bool areMany = visitNeighbors(tree, pathToNode(tree, leaf),
    [&](std::size_t neighbor)
    {
      memory.push_back(static_cast<typename TSample::Id>(neighbor));
      return memory.size() > most;
    });
  return areMany ? List{} : List{ memory.data(), memory.size() };
}

/// Visits the unsplit nodes, other than the path's own, that touch a box, and perhaps a few others.
/// The box must touch the path's region.
/// @param visit see visitTouchingInSubtree()
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

/// Whether samples of a node may be on the other side of the isovalue.
/// @param isBelow this side: below the isovalue, or not
template <class TSample>
bool mayHoldOtherSide(const Node<TSample>& node, double isovalue, bool isBelow)
{
  return isBelow ? node.maximum >= isovalue : node.minimum < isovalue;
}

/// Whether a node that touches the surrounded one has samples on the other side of the isovalue.
/// Value ranges prune the search.
/// @param isBelow the side of the surrounded node: below the isovalue, or not
template <class TSample>
bool touchesOtherSide(const SampleTree<TSample>& tree, const TouchingRoots& surroundings,
  int nodeDepth, double isovalue, bool isBelow)
{
  return visitTouching(
    tree, surroundings, nodeDepth,
    [isovalue, isBelow](const Node<TSample>& node)
    { return mayHoldOtherSide(node, isovalue, isBelow); },
    [](std::size_t) { return true; });
}

} // namespace isopoint
