// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Region.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/Path.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/TreeletSplitting.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace isopoint
{

/// How a node is described to another rank.
enum class NodeKind : std::uint8_t
{
  Split,   // axis, plane, number of samples of the lower child; then both children
  Samples, // its samples, coincident ones in the order of ids
  Absent   // only its value range
};

/// Splits nodes of this rank in boxes, down to leaves or a depth, and writes them for another rank.
template <class TSample>
class NodeWriter
{
public:
  explicit NodeWriter(SampleTree<TSample>& tree)
    : Tree(tree)
    , Splitter(tree, 0)
  {
  }

  /// Writes a node and its descendants that touch any box. Nodes at `depth`, and those that touch
  /// no box, are written as ranges; small nodes above `depth` as samples.
  void write(const BinaryIndex& index, int depth, const std::vector<Region>& boxes, ByteBuffer& out)
  {
    Path path = pathTo(this->Tree, index);
    this->write(path, depth, boxes, out);
  }

  /// Splits a node down to leaves wherever it touches any box.
  void refine(std::size_t nodeIndex, const std::vector<Region>& boxes)
  {
    Path path = pathToNode(this->Tree, nodeIndex);
    this->refine(path, boxes);
  }

private:
  /// Nodes of up to this many samples are sent whole: mostly all of them are needed.
  static constexpr std::size_t fewSamples = 32;

  void write(Path& path, int depth, const std::vector<Region>& boxes, ByteBuffer& out)
  {
    const std::size_t nodeIndex = path.nodeIndex();
    if ((path.depth < depth) && this->Tree.nodes[nodeIndex].count() > fewSamples)
    {
      this->splitOnce(path);
    }
    const Node<TSample> node = this->Tree.nodes[nodeIndex];
    if (path.depth >= depth)
    {
      this->writeAbsent(node, out);
    }
    else if (node.isLeaf || node.count() <= fewSamples)
    {
      append(out, NodeKind::Samples);
      append(out, this->Tree.samples.data() + node.begin, node.count());
    }
    else
    {
      append(out, NodeKind::Split);
      append(out, node.axis);
      append(out, node.plane);
      append(out, static_cast<std::uint64_t>(this->Tree.nodes[node.lowerNode()].count()));
      for (const bool upper : { false, true })
      {
        const std::vector<Region> touching = touchingChild(node, upper, boxes);
        if (touching.empty())
        {
          this->writeAbsent(this->Tree.nodes[this->Tree.child(node, upper)], out);
        }
        else
        {
          descend(this->Tree, path, upper);
          this->write(path, depth, touching, out);
          ascend(path);
        }
      }
    }
  }

  void writeAbsent(const Node<TSample>& node, ByteBuffer& out)
  {
    append(out, NodeKind::Absent);
    append(out, node.minimum);
    append(out, node.maximum);
  }

  static std::vector<Region> touchingChild(
    const Node<TSample>& node, bool upper, const std::vector<Region>& boxes)
  {
    std::vector<Region> touching;
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(touching),
      [&](const Region& box)
      { return upper ? node.plane <= box.upper[node.axis] : node.plane >= box.lower[node.axis]; });
    return touching;
  }

  void refine(Path& path, const std::vector<Region>& boxes)
  {
    this->splitOnce(path);
    const Node<TSample> node = this->Tree.nodes[path.nodeIndex()];
    if (node.isLeaf || node.isAbsent)
    {
      return;
    }
    for (const bool upper : { false, true })
    {
      const std::vector<Region> touching = touchingChild(node, upper, boxes);
      if (!touching.empty())
      {
        descend(this->Tree, path, upper);
        this->refine(path, touching);
        ascend(path);
      }
    }
  }

  /// Splits a node a few levels deep, if it is neither split nor a leaf.
  void splitOnce(const Path& path)
  {
    const std::size_t nodeIndex = path.nodeIndex();
    const Node<TSample> node = this->Tree.nodes[nodeIndex];
    if (node.isSplit() || node.isLeaf || node.isAbsent)
    {
      return;
    }
    const int levels = std::min(treeletLevels, maximumDepth - path.depth);
    if (levels <= 0)
    {
      throwTooDeep();
    }
    this->Splitter.moveTo(appendPairs(this->Tree, maximumTreeletPairs(node.count(), levels)));
    this->Splitter.split(this->Tree.nodes[nodeIndex], path.region, levels);
  }

  SampleTree<TSample>& Tree;
  TreeletSplitter<TSample> Splitter;
};

/// Adds the nodes that another rank's NodeWriter wrote to this rank's tree.
template <class TSample>
class NodeReader
{
public:
  explicit NodeReader(SampleTree<TSample>& tree)
    : Tree(tree)
    , Splitter(tree, 0)
  {
  }

  /// @param nodeIndex an absent node
  /// @throws std::bad_alloc, TreeTooLarge, the node unchanged
  void read(std::size_t nodeIndex, ByteReader& in)
  {
    const Node<TSample> former = this->Tree.nodes[nodeIndex];
    Path path = pathToNode(this->Tree, nodeIndex);
    try
    {
      this->read(path, in);
    }
    catch (...)
    {
      this->Tree.nodes[nodeIndex] = former;
      throw;
    }
  }

private:
  void read(Path& path, ByteReader& in)
  {
    const std::size_t nodeIndex = path.nodeIndex();
    const auto kind = in.read<NodeKind>();
    if (kind == NodeKind::Absent)
    {
      Node<TSample>& node = this->Tree.nodes[nodeIndex];
      node.isAbsent = true;
      node.isLeaf = false;
      node.minimum = in.read<typename TSample::Value>();
      node.maximum = in.read<typename TSample::Value>();
    }
    else if (kind == NodeKind::Samples)
    {
      this->readSamples(path, in);
    }
    else
    {
      this->readSplit(path, in);
    }
  }

  /// Splits the samples down to leaves.
  void readSamples(const Path& path, ByteReader& in)
  {
    const std::size_t nodeIndex = path.nodeIndex();
    const std::size_t count = this->Tree.nodes[nodeIndex].count();
    in.read(this->Tree.samples.data() + this->Tree.nodes[nodeIndex].begin, count);
    const int levels = maximumDepth - path.depth;
    this->Splitter.moveTo(appendPairs(this->Tree, count - 1));
    Node<TSample>& node = this->Tree.nodes[nodeIndex];
    node.isAbsent = false;
    node.isLeaf = count == 1;
    this->Splitter.split(node, path.region, levels);
  }

  void readSplit(Path& path, ByteReader& in)
  {
    const std::size_t nodeIndex = path.nodeIndex();
    const std::size_t pair = appendPairs(this->Tree, 1);
    Node<TSample>& node = this->Tree.nodes[nodeIndex];
    node.axis = in.read<std::uint8_t>();
    node.plane = in.read<double>();
    const std::size_t middle = node.begin + in.read<std::uint64_t>();
    node.childPair = static_cast<typename TSample::Id>(pair);
    node.isAbsent = false;
    node.isLeaf = false;
    this->Tree.nodes[node.lowerNode()] = makeNode<TSample>(node.begin, middle);
    this->Tree.nodes[node.upperNode()] = makeNode<TSample>(middle, node.end);
    for (const bool upper : { false, true })
    {
      descend(this->Tree, path, upper);
      this->read(path, in);
      ascend(path);
    }
    Node<TSample>& parent = this->Tree.nodes[nodeIndex];
    uniteRanges(parent, this->Tree.nodes[parent.lowerNode()], this->Tree.nodes[parent.upperNode()]);
  }

  SampleTree<TSample>& Tree;
  TreeletSplitter<TSample> Splitter;
};

} // namespace isopoint
