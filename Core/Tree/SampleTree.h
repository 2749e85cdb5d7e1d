// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleTree_h
#define isopoint_SampleTree_h

#include "Core/Base/RawArray.h"
#include "Core/Base/Region.h"
#include "Core/Tree/Sample.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>

namespace isopoint
{

/// A node of the kd-tree, identified by its index in SampleTree::nodes. Siblings are stored side by
/// side, as a pair with one number; pair 0 is never given out.
template <class TSample>
struct Node
{
  using Value = typename TSample::Value;
  using Id = typename TSample::Id;

  double plane;      // where the region is cut, once split
  Id begin;          // its samples are [begin, end) of the tree's
  Id end;            //
  Id childPair;      // the children are the nodes 2 childPair and 2 childPair + 1; see isSplit()
  Value minimum;     // of the samples' values
  Value maximum;     //
  std::uint8_t axis; // the plane's, once split
  bool isLeaf;       // all its samples share one position
  bool isAbsent;     // its samples are held by another rank; see MissingNode

  /// Whether it has children; a node that is neither split nor a leaf may be split later.
  bool isSplit() const { return this->childPair != 0; }
  std::size_t lowerNode() const { return 2 * static_cast<std::size_t>(this->childPair); }
  std::size_t upperNode() const { return this->lowerNode() + 1; }
  std::size_t count() const { return static_cast<std::size_t>(this->end - this->begin); }
};

/// Thrown by a search for samples that this rank does not hold, or not in the form that is needed:
/// nobody guesses. Once they have been fetched, the search must be repeated.
struct MissingNode : std::exception
{
  MissingNode(std::size_t node, const Region& needed)
    : nodeIndex(node)
    , box(needed)
  {
  }

  const char* what() const noexcept override { return "samples of another rank are missing"; }

  std::size_t nodeIndex;
  Region box; // where the samples are needed
};

/// The samples in the order of the tree, and as much of the kd-tree as the isovalues so far needed
/// ([RL06] section 4; docs/algorithm.md, sections 3 and 9). Splitting a node only permutes
/// the samples inside it, so a tree may be refined further at any time.
/// Memory: sizeof(TSample) for each sample and sizeof(Node) for each node.
template <class TSample>
struct SampleTree
{
  using NodeType = Node<TSample>;

  RawArray<TSample> samples;
  RawArray<NodeType> nodes;
  std::size_t usedPairs = 0; // pairs of nodes given out, pair 0 (which holds the root) included
  Region region{};           // the root's
  std::size_t skipped = 0;   // samples left out
  double valueError = 0.0;   // standard error that each value has at least, as by rounding

  /// Where a tree is shared among ranks, each of them has the samples [ownBegin, ownEnd) for its
  /// own and copies of some others; `samples` has room for all, of which no page is touched that
  /// holds none. Every node that is split lies in the same place in the trees of all ranks.
  bool isPartial = false;
  std::size_t ownBegin = 0;
  std::size_t ownEnd = std::numeric_limits<std::size_t>::max();

  static constexpr std::size_t rootNode = 1;

  bool isEmpty() const { return this->samples.size() == 0; }

  /// Whether any of a node's samples is this rank's own.
  bool hasOwn(const NodeType& node) const
  {
    return node.begin < this->ownEnd && node.end > this->ownBegin;
  }

  /// Whether a place in the order of the samples is this rank's own.
  bool isOwn(std::size_t place) const { return place >= this->ownBegin && place < this->ownEnd; }

  /// The number of samples that are this rank's own.
  std::size_t ownCount() const
  {
    return this->isPartial ? this->ownEnd - this->ownBegin : this->samples.size();
  }

  /// The first sample of a node: of a leaf that of the lowest id.
  const TSample& sampleOf(std::size_t nodeIndex) const
  {
    return this->samples[this->nodes[nodeIndex].begin];
  }

  std::size_t child(const NodeType& node, bool upper) const
  {
    return upper ? node.upperNode() : node.lowerNode();
  }
};

/// The node below another one whose region contains a box, as far down as nodes are split.
template <class TSample>
std::size_t smallestAround(
  const SampleTree<TSample>& tree, std::size_t nodeIndex, const Region& box)
{
  for (;;)
  {
    const Node<TSample>& node = tree.nodes[nodeIndex];
    if (!node.isSplit() ||
        (box.lower[node.axis] <= node.plane && box.upper[node.axis] >= node.plane))
    {
      return nodeIndex;
    }
    nodeIndex = tree.child(node, box.lower[node.axis] > node.plane);
  }
}

inline std::size_t siblingOf(std::size_t nodeIndex)
{
  return nodeIndex ^ 1;
}

/// Appends pairs of nodes to be filled in. @returns the number of the first one
/// @throws std::bad_alloc, or std::length_error if an id cannot number the nodes; the tree
/// unchanged
template <class TSample>
std::size_t appendPairs(SampleTree<TSample>& tree, std::size_t pairCount)
{
  const std::size_t first = tree.usedPairs;
  const std::size_t nodeCount = 2 * (first + pairCount);
  if (nodeCount > std::numeric_limits<typename TSample::Id>::max())
  {
    throw std::length_error("the tree has more nodes than its ids can number");
  }
  if (nodeCount > tree.nodes.size())
  {
    constexpr std::size_t spare = 8192; // where a tree grows in small steps
    tree.nodes.resize(nodeCount + (tree.isPartial ? spare : 0));
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

/// A node with the samples [begin, end), neither split nor ranged.
template <class TSample>
Node<TSample> makeNode(std::size_t begin, std::size_t end)
{
  Node<TSample> node{};
  node.begin = static_cast<typename TSample::Id>(begin);
  node.end = static_cast<typename TSample::Id>(end);
  node.isLeaf = end - begin == 1;
  return node;
}

} // namespace isopoint

#endif
