// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/SampleTree.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// The path from the root to a node, and the node's region.
struct Path
{
  BinaryIndex index = rootIndex;
  int depth = 0;
  std::size_t nodeIndices[maximumDepth + 1]; // by depth: ancestors, then the node
  double planes[maximumDepth];               // that split the ancestors
  std::uint8_t axes[maximumDepth];           // of these planes
  bool uppers[maximumDepth];                 // whether the path takes the upper child
  double formerBounds[maximumDepth];         // of the region, before each plane cut it
  Region region{};

  std::size_t nodeIndex() const { return this->nodeIndices[this->depth]; }
};

template <class TSample>
Path pathToRoot(const SampleTree<TSample>& tree)
{
  Path path;
  path.nodeIndices[0] = rootNode;
  path.region = tree.region;
  return path;
}

/// Extends the path to a child of its node.
template <class TSample>
void descend(const SampleTree<TSample>& tree, Path& path, bool upper)
{
  const Node<TSample>& node = tree.nodes[path.nodeIndex()];
  path.index = upper ? upperChild(path.index) : lowerChild(path.index);
  assert(path.depth < maximumDepth);
  double& bound = upper ? path.region.lower[node.axis] : path.region.upper[node.axis];
  path.planes[path.depth] = node.plane;
  path.axes[path.depth] = node.axis;
  path.uppers[path.depth] = upper;
  path.formerBounds[path.depth] = bound;
  path.nodeIndices[++path.depth] = tree.child(node, upper);
  bound = node.plane;
}

inline void ascend(Path& path)
{
  path.index = ancestorOf(path.index, 1);
  --path.depth;
  const bool upper = path.uppers[path.depth];
  const int axis = path.axes[path.depth];
  (upper ? path.region.lower[axis] : path.region.upper[axis]) = path.formerBounds[path.depth];
}

/// Moves a path to a node over the nearest common ancestor: a few steps to the next node in order.
template <class TSample>
void moveTo(const SampleTree<TSample>& tree, Path& path, const BinaryIndex& index)
{
  const int depth = depthOf(index);
  while (path.depth > depth || path.index != ancestorOf(index, depth - path.depth))
  {
    ascend(path);
  }
  while (path.depth < depth)
  {
    descend(tree, path, isUpperChild(ancestorOf(index, depth - path.depth - 1)));
  }
}

/// O(depth)
template <class TSample>
Path pathTo(const SampleTree<TSample>& tree, const BinaryIndex& index)
{
  Path path = pathToRoot(tree);
  moveTo(tree, path, index);
  return path;
}

/// The path to a leaf, found by the position of its samples in tree order. O(depth)
template <class TSample>
Path pathToNode(const SampleTree<TSample>& tree, std::size_t leafNode)
{
  Path path = pathToRoot(tree);
  while (path.nodeIndex() != leafNode)
  {
    const Node<TSample>& upper = tree.nodes[tree.nodes[path.nodeIndex()].upperNode()];
    descend(tree, path, tree.nodes[leafNode].begin >= upper.begin);
  }
  return path;
}

/// Visits the descendants of the path's node at depth `nodeDepth`, and unsplit ones above it.
/// @param visit(path) called with the path to each; `path` is restored at the end
template <class TSample, class Visitor>
void forEachBelow(const SampleTree<TSample>& tree, Path& path, int nodeDepth, const Visitor& visit)
{
  if (path.depth == nodeDepth || !tree.nodes[path.nodeIndex()].isSplit())
  {
    visit(path);
    return;
  }
  for (const bool upper : { false, true })
  {
    descend(tree, path, upper);
    forEachBelow(tree, path, nodeDepth, visit);
    ascend(path);
  }
}

} // namespace isopoint
