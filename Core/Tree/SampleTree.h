// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Base/Region.h"
#include "Core/Base/Sorting.h"
#include "Core/Base/Vector.h"
#include "Core/Tree/BinaryIndex.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace isopoint
{

/// One sample in the tree, with all data for building and searching. Positions and values keep the
/// input's type; the id is the sample's number in the input.
template <class TCoordinate, class TValue, class TId>
struct Sample
{
  using Coordinate = TCoordinate;
  using Value = TValue;
  using Id = TId;

  TCoordinate position[3];
  TId id;
  TValue value;
};

/// The layouts in use. Those with 32-bit ids hold fewer than 2^30 samples, since ids also number
/// nodes: two for each sample, and some that are reserved but unused. WideSample holds any cloud,
/// since float converts to double exactly.
using FloatSample = Sample<float, float, std::uint32_t>;
using FloatSampleOfDouble = Sample<float, double, std::uint32_t>;
using DoubleSampleOfFloat = Sample<double, float, std::uint32_t>;
using WideSample = Sample<double, double, std::uint64_t>;

static_assert(sizeof(FloatSample) == 20, "the commonest layout has no padding");

template <class TSample>
Vector positionOf(const TSample& sample)
{
  return { sample.position[0], sample.position[1], sample.position[2] };
}

template <class TSample>
bool haveOnePosition(const TSample& a, const TSample& b)
{
  return a.position[0] == b.position[0] && a.position[1] == b.position[1] &&
         a.position[2] == b.position[2];
}

/// A node of the kd-tree, identified by its index in SampleTree::nodes. Siblings are adjacent and
/// form a pair with one number; pair 0 never holds children.
template <class TSample>
struct Node
{
  using Value = typename TSample::Value;
  using Id = typename TSample::Id;

  double plane; // splitting plane, if split
  Id begin;     // samples [begin, end) of the tree
  Id end;
  Id childPair;  // index of the lower child / 2, or 0; see isSplit()
  Value minimum; // range of the samples' values
  Value maximum;
  std::uint8_t axis; // of the plane, if split
  bool isLeaf;       // all its samples share one position
  bool isAbsent;     // another rank holds its samples; see MissingNode
  bool isBucket;     // few samples, all at different positions: see splitToBuckets()

  /// Nodes that are neither split nor leaves may be split later.
  bool isSplit() const { return this->childPair != 0; }
  std::size_t lowerNode() const { return 2 * static_cast<std::size_t>(this->childPair); }
  std::size_t upperNode() const { return this->lowerNode() + 1; }
  std::size_t count() const { return this->end - this->begin; }

  /// The end of the samples to look at for positions. Of a leaf, whose samples share one position,
  /// the first sample suffices.
  std::size_t positionsEnd() const { return this->isLeaf ? this->begin + Id{ 1 } : this->end; }
};

/// Thrown by searches that need samples this rank does not hold, or that need a node to be split
/// further. Fetch them and repeat the search.
struct MissingNode : std::exception
{
  MissingNode(std::size_t node, const Region& needed)
    : nodeIndex(node)
    , box(needed)
  {
  }

  const char* what() const noexcept override { return "a node of the tree is missing"; }

  std::size_t nodeIndex;
  Region box; // where samples are needed
};

/// The index of the root in SampleTree::nodes.
constexpr std::size_t rootNode = 1;

/// Samples in tree order, and the part of the kd-tree that the isovalues so far needed ([RL06]
/// section 4; docs/algorithm.md, sections 3 and 9). A split only permutes samples within a node, so
/// the tree can be refined at any time. Memory: sizeof(TSample) per sample, sizeof(Node) per node.
template <class TSample>
struct SampleTree
{
  using NodeType = Node<TSample>;

  RawArray<TSample> samples;
  RawArray<NodeType> nodes;
  std::size_t usedPairs = 0; // pairs in use, including pair 0, which holds the root
  Region region{};           // of the root
  std::size_t skipped = 0;   // samples left out
  double valueError = 0.0;   // least standard error of each value, as by rounding

  /// A tree shared among ranks: each rank owns the samples [ownBegin, ownEnd) and has copies of
  /// some others. `samples` has room for all; pages without samples are never touched. Nodes that
  /// several ranks have split have the same plane on all of them.
  bool isPartial = false;
  std::size_t ownBegin = 0;
  std::size_t ownEnd = std::numeric_limits<std::size_t>::max();

  bool isEmpty() const { return this->samples.size() == 0; }

  /// Whether this rank owns any of a node's samples.
  bool hasOwn(const NodeType& node) const
  {
    return node.begin < this->ownEnd && node.end > this->ownBegin;
  }

  /// Whether this rank owns all of a node's samples.
  bool hasOnlyOwn(const NodeType& node) const
  {
    return node.begin >= this->ownBegin && node.end <= this->ownEnd;
  }

  /// Whether this rank owns the sample with a *tree index*: an index into `samples`, the same on
  /// all ranks.
  bool isOwn(std::size_t treeIndex) const
  {
    return treeIndex >= this->ownBegin && treeIndex < this->ownEnd;
  }

  std::size_t ownCount() const
  {
    return this->isPartial ? this->ownEnd - this->ownBegin : this->samples.size();
  }

  /// The first sample of a node; for a leaf, the one with the lowest id.
  const TSample& sampleOf(std::size_t nodeIndex) const
  {
    return this->samples[this->nodes[nodeIndex].begin];
  }

  std::size_t child(const NodeType& node, bool upper) const
  {
    return upper ? node.upperNode() : node.lowerNode();
  }
};

/// @param needed() the box where samples are needed
/// @throws MissingNode if another rank holds the node's samples
template <class TSample, class Needed>
void requireSamples(const SampleTree<TSample>& tree, std::size_t nodeIndex, const Needed& needed)
{
  if (tree.nodes[nodeIndex].isAbsent)
  {
    throw MissingNode{ nodeIndex, needed() };
  }
}

/// The deepest node, at or below another one, whose region contains a box.
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

/// Searches a node depth-first for the samples that a search wants.
/// @param region contains all wanted samples; a part of the node's
/// @param search mayHold(node, region): whether a wanted sample may be in a part of the region;
/// isUpperFirst(node): which child to search first; needed(region): see requireSamples();
/// add(nodeIndex): takes the samples of an unsplit node, and returns true to end the search
/// @returns whether add() ended the search
/// @throws MissingNode at a node whose samples another rank holds
template <class TSample, class TSearch>
bool searchRegion(
  const SampleTree<TSample>& tree, std::size_t nodeIndex, const Region& region, TSearch& search)
{
  nodeIndex = smallestAround(tree, nodeIndex, region);
  const Node<TSample>& node = tree.nodes[nodeIndex];
  if (!search.mayHold(node, region))
  {
    return false;
  }
  if (!node.isSplit())
  {
    requireSamples(tree, nodeIndex, [&]() { return search.needed(region); });
    return search.add(nodeIndex);
  }
  const bool isUpperFirst = search.isUpperFirst(node);
  for (const bool isUpper : { isUpperFirst, !isUpperFirst })
  {
    Region part = region;
    (isUpper ? part.lower : part.upper)[node.axis] = node.plane;
    if (searchRegion(tree, tree.child(node, isUpper), part, search))
    {
      return true;
    }
  }
  return false;
}

/// Disjoint nodes, each once, by their samples, in the order that all ranks share. O(n log n)
/// @throws std::bad_alloc, Aborted
template <class TSample>
std::vector<std::size_t> inTreeOrder(const Execution& execution, const SampleTree<TSample>& tree,
  const std::vector<std::size_t>& nodes)
{
  using Begin = std::pair<std::size_t, std::size_t>; // far faster than looking up begins
  std::vector<Begin> byBegin(nodes.size());
  forEachIndex(execution, nodes.size(),
    [&](std::size_t i) {
      byBegin[i] = { tree.nodes[nodes[i]].begin, nodes[i] };
    });
  byBegin = sortedUnique(
    execution, byBegin, tree.samples.size(), [](const Begin& begin) { return begin.first; });
  std::vector<std::size_t> ordered(byBegin.size());
  forEachIndex(execution, ordered.size(), [&](std::size_t i) { ordered[i] = byBegin[i].second; });
  return ordered;
}

inline std::size_t siblingOf(std::size_t nodeIndex)
{
  return nodeIndex ^ 1;
}

/// Appends uninitialized pairs of nodes. @returns the number of the first one
/// @throws std::bad_alloc, or TreeTooLarge if ids cannot number the nodes; without effect then
template <class TSample>
std::size_t appendPairs(SampleTree<TSample>& tree, std::size_t pairCount)
{
  const std::size_t first = tree.usedPairs;
  const std::size_t nodeCount = 2 * (first + pairCount);
  if (nodeCount > std::numeric_limits<typename TSample::Id>::max())
  {
    throw TreeTooLarge("the tree has more nodes than its ids can number");
  }
  if (nodeCount > tree.nodes.size())
  {
    constexpr std::size_t spare = 8192; // partial trees grow in small steps
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

/// A node of the samples [begin, end), unsplit and without a value range.
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
