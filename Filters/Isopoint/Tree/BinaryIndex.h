// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_BinaryIndex_h
#define isopoint_BinaryIndex_h

#include <cstddef>

namespace isopoint
{

/// The name of a node of the kd-tree (section 4 of the paper): the root is 1, and below the
/// leading 1 each bit tells the way down, 0 to the lower and 1 to the upper child. The name alone
/// answers where a node stands among the others; no tree is needed.
__extension__ using BinaryIndex = unsigned __int128;

constexpr BinaryIndex rootIndex = 1;

/// No index is deeper than its 128 bits allow. Halving at the median keeps a tree of n samples
/// within ceil(log2 n) levels. Samples of one position stay together, which can part off as little
/// as one sample on each axis before the heap is alone: heaps nested in heaps take up to four
/// levels for each halving, 4 log2 n in all.
constexpr int maximumDepth = 127;

constexpr BinaryIndex lowerChild(BinaryIndex node)
{
  return node << 1;
}

constexpr BinaryIndex upperChild(BinaryIndex node)
{
  return (node << 1) ^ 1;
}

constexpr bool isUpperChild(BinaryIndex node)
{
  return (node & 1) != 0;
}

/// Levels below the root.
constexpr int depthOf(BinaryIndex node)
{
  int depth = 0;
  while (node >>= 1)
  {
    ++depth;
  }
  return depth;
}

/// The levels of a tree that halves so many samples exactly: ceil(log2 count), count at least 1.
constexpr int levelsToHalve(std::size_t count)
{
  return count > 1 ? depthOf(count - 1) + 1 : 0;
}

} // namespace isopoint

#endif
