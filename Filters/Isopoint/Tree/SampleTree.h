// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleTree_h
#define isopoint_SampleTree_h

#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Tree/BinaryIndex.h"
#include "Isopoint/Base/RawArray.h"
#include "Isopoint/Base/Region.h"
#include "Isopoint/Tree/Sample.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace isopoint
{

/// A node of the kd-tree. Children stand side by side, a pair behind one number; the number 0,
/// where no pair stands, marks a node that was not split (yet, or ever).
template <class TSample>
struct Node
{
  using Value = typename TSample::Value;
  using Id = typename TSample::Id;

  double plane;      // where the region is cut, once split
  Id begin;          // its samples are [begin, end) of the tree's
  Id end;            //
  Id childPair;      // the children's nodeIndices are 2 childPair and 2 childPair + 1
  Value minimum;     // of the samples' values
  Value maximum;     //
  std::uint8_t axis; // the plane's, once split
  bool isLeaf;       // all its samples share one position

  bool isSplit() const { return this->childPair != 0; }
  std::size_t lowerNode() const { return 2 * static_cast<std::size_t>(this->childPair); }
  std::size_t upperNode() const { return this->lowerNode() + 1; }
  std::size_t count() const { return static_cast<std::size_t>(this->end - this->begin); }
};

/// The samples in the order of the tree, and as much of the tree as any isovalue needed so far
/// (section 4 of the paper; DESIGN: "The narrow band"). Splitting a node only permutes the samples
/// inside it, so a tree may be refined further at any time. Slot 1 holds the root; nodeIndex 0 is empty.
/// Memory: sizeof(TSample) for each sample and sizeof(Node) for each node.
template <class TSample>
struct SampleTree
{
  using NodeType = Node<TSample>;

  RawArray<TSample> samples;
  RawArray<NodeType> nodes;
  std::size_t usedPairs = 0; // pairs of nodeIndices given out, nodeIndices 0 and 1 included
  Region region{};           // the root's
  std::size_t skipped = 0;   // samples left out
  NeighborhoodCache<typename TSample::Id> neighborhoods;

  static constexpr std::size_t rootNode = 1;

  bool isEmpty() const { return this->samples.size() == 0; }

  std::size_t child(const NodeType& node, bool upper) const
  {
    return upper ? node.upperNode() : node.lowerNode();
  }
};

/// Siblings stand side by side.
inline std::size_t siblingOf(std::size_t nodeIndex)
{
  return nodeIndex ^ 1;
}

/// Makes room for that many more pairs of children. @returns the first one's number
/// @throws std::bad_alloc, or std::length_error if an id cannot number the nodeIndices; the tree
/// unchanged
template <class TSample>
std::size_t appendPairs(SampleTree<TSample>& tree, std::size_t pairCount)
{
  const std::size_t first = tree.usedPairs;
  const std::size_t nodeIndices = 2 * (first + pairCount);
  if (nodeIndices > std::numeric_limits<typename TSample::Id>::max())
  {
    throw std::length_error("the tree has more nodes than its ids can number");
  }
  if (nodeIndices > tree.nodes.size())
  {
    tree.nodes.resize(nodeIndices);
  }
  tree.usedPairs = first + pairCount;
  return first;
}

template <class TSample>
void computeRange(Node<TSample>& node, const TSample* samples)
{
  typename TSample::Value minimum = samples[node.begin].value;
  typename TSample::Value maximum = minimum;
  for (std::size_t i = node.begin; i < node.end; ++i)
  {
    minimum = std::min(minimum, samples[i].value);
    maximum = std::max(maximum, samples[i].value);
  }
  node.minimum = minimum;
  node.maximum = maximum;
}

template <class TSample>
void uniteRanges(Node<TSample>& node, const Node<TSample>& lower, const Node<TSample>& upper)
{
  node.minimum = std::min(lower.minimum, upper.minimum);
  node.maximum = std::max(lower.maximum, upper.maximum);
}

/// A node of nobody's yet, with the samples [begin, end).
template <class TSample>
Node<TSample> makeNode(std::size_t begin, std::size_t end)
{
  Node<TSample> node{};
  node.begin = static_cast<typename TSample::Id>(begin);
  node.end = static_cast<typename TSample::Id>(end);
  node.isLeaf = end - begin == 1;
  return node;
}

/// The way from the root to a node, and the node's region.
struct Path
{
  BinaryIndex index = rootIndex;
  int depth = 0;
  std::size_t nodeIndices[maximumDepth + 1]; // of the ancestors by depth, the node's own last
  double planes[maximumDepth];         // that cut their regions
  std::uint8_t axes[maximumDepth];     // of these planes
  bool uppers[maximumDepth];           // whether the way went to their upper sides
  Region region{};

  std::size_t nodeIndex() const { return this->nodeIndices[this->depth]; }
};

template <class TSample>
Path pathToRoot(const SampleTree<TSample>& tree)
{
  Path path;
  path.nodeIndices[0] = SampleTree<TSample>::rootNode;
  path.region = tree.region;
  return path;
}

/// Goes on to a child of the path's node. @returns what undoes it in the region
template <class TSample>
double descend(const SampleTree<TSample>& tree, Path& path, bool upper)
{
  const Node<TSample>& node = tree.nodes[path.nodeIndex()];
  path.index = upper ? upperChild(path.index) : lowerChild(path.index);
  assert(path.depth < maximumDepth);
  path.planes[path.depth] = node.plane;
  path.axes[path.depth] = node.axis;
  path.uppers[path.depth] = upper;
  path.nodeIndices[++path.depth] = tree.child(node, upper);
  double& bound = upper ? path.region.lower[node.axis] : path.region.upper[node.axis];
  const double former = bound;
  bound = node.plane;
  return former;
}

/// Goes back to the parent; `former` is what descend() gave.
inline void ascend(Path& path, double former)
{
  path.index >>= 1;
  --path.depth;
  const bool upper = path.uppers[path.depth];
  const int axis = path.axes[path.depth];
  (upper ? path.region.lower[axis] : path.region.upper[axis]) = former;
}

/// The path to the node of that name, found by its bits alone. O(depth)
template <class TSample>
Path pathTo(const SampleTree<TSample>& tree, BinaryIndex index)
{
  Path path = pathToRoot(tree);
  for (int bit = depthOf(index) - 1; bit >= 0; --bit)
  {
    descend(tree, path, isUpperChild(index >> bit));
  }
  return path;
}

/// The path to a leaf, found by the place of its samples. O(depth)
template <class TSample>
Path pathToLeaf(const SampleTree<TSample>& tree, std::size_t leafNode)
{
  Path path = pathToRoot(tree);
  while (path.nodeIndex() != leafNode)
  {
    const Node<TSample>& upper = tree.nodes[tree.nodes[path.nodeIndex()].upperNode()];
    descend(tree, path, tree.nodes[leafNode].begin >= upper.begin);
  }
  return path;
}

/// Visits the nodes of the depth `nodeDepth` below the path's node, and the unsplit ones above
/// that depth; `visit` gets the path to each.
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
    const double former = descend(tree, path, upper);
    forEachBelow(tree, path, nodeDepth, visit);
    ascend(path, former);
  }
}

} // namespace isopoint

#endif
