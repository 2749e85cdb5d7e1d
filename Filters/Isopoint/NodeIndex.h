// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NodeIndex_h
#define isopoint_NodeIndex_h

#include <cstdint>

namespace isopoint
{

/// The name of a node of the kd-tree (section 4 of the paper): the root is 1, and below the
/// leading 1 each bit tells the way down, 0 to the lower and 1 to the upper child. The name alone
/// answers where a node stands among the others; no tree is needed.
using NodeIndex = std::uint64_t;

constexpr NodeIndex rootIndex = 1;

/// No index is deeper than its 64 bits allow. Halving at the median keeps a tree of n samples
/// within ceil(log2 n) levels; samples of one position add at most four (they stay together,
/// which parts off what lies behind them once for each axis, then the rest).
constexpr int maximumDepth = 63;

constexpr NodeIndex lowerChild(NodeIndex node)
{
  return node << 1;
}

constexpr NodeIndex upperChild(NodeIndex node)
{
  return (node << 1) ^ 1;
}

constexpr bool isUpperChild(NodeIndex node)
{
  return (node & 1) != 0;
}

/// Levels below the root.
constexpr int depthOf(NodeIndex node)
{
  int depth = 0;
  while (node >>= 1)
  {
    ++depth;
  }
  return depth;
}

/// The node itself or the one above it that stands `depth` levels below the root,
/// 0 <= depth <= depthOf(node).
constexpr NodeIndex ancestorAtDepth(NodeIndex node, int nodeDepth, int depth)
{
  return node >> (nodeDepth - depth);
}

} // namespace isopoint

#endif
