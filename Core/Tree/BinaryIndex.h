// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_BinaryIndex_h
#define isopoint_BinaryIndex_h

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace isopoint
{

/// The binary index of a node of the kd-tree ([RL06] section 4), a number of 128 bits: that of the
/// root is 1, and each further bit leads to a child, 0 to the lower and 1 to the upper one. It
/// names a node whatever part of the tree has been built.
struct BinaryIndex
{
  std::uint64_t high = 0;
  std::uint64_t low = 0;
};

constexpr BinaryIndex rootIndex{ 0, 1 };

constexpr bool operator==(const BinaryIndex& a, const BinaryIndex& b)
{
  return a.high == b.high && a.low == b.low;
}
constexpr bool operator!=(const BinaryIndex& a, const BinaryIndex& b)
{
  return !(a == b);
}

/// The depth of the deepest node that 128 bits can name. Halving at the median keeps a tree of n
/// samples at different positions within ceil(log2 n) levels. Coincident samples stay together, so
/// that a split may part off as little as one sample on each axis before they are alone: nested
/// groups of coincident samples take up to four levels for each halving, 4 log2 n in all.
constexpr int maximumDepth = 127;

/// Where a tree would have to be deeper. @throws std::length_error
[[noreturn]] inline void throwTooDeep()
{
  throw std::length_error("the tree is deeper than 127 levels: nested duplicate points");
}

constexpr BinaryIndex lowerChild(const BinaryIndex& node)
{
  return { node.high << 1 | node.low >> 63, node.low << 1 };
}

constexpr BinaryIndex upperChild(const BinaryIndex& node)
{
  return { node.high << 1 | node.low >> 63, node.low << 1 | 1 };
}

constexpr bool isUpperChild(const BinaryIndex& node)
{
  return (node.low & 1) != 0;
}

/// The ancestor this many levels above a node, 0 to 127; 0 above the root.
constexpr BinaryIndex ancestorOf(const BinaryIndex& node, int levels)
{
  constexpr int bits = 64;
  if (levels == 0)
  {
    return node;
  }
  return levels < bits
           ? BinaryIndex{ node.high >> levels, node.high << (bits - levels) | node.low >> levels }
           : BinaryIndex{ 0, node.high >> (levels - bits) };
}

/// The place of the highest bit that is set: the logarithm to base 2, rounded down. Not of 0.
constexpr int highestBit(std::uint64_t number)
{
  int place = 0;
  for (int step = 32; step > 0; step /= 2)
  {
    if (number >> step != 0)
    {
      number >>= step;
      place += step;
    }
  }
  return place;
}

/// Levels below the root. The node is not 0.
constexpr int depthOf(const BinaryIndex& node)
{
  return node.high != 0 ? 64 + highestBit(node.high) : highestBit(node.low);
}

/// The levels of a tree that halves this many samples exactly: ceil(log2 count), count at least 1.
constexpr int levelsToHalve(std::size_t count)
{
  return count > 1 ? highestBit(count - 1) + 1 : 0;
}

} // namespace isopoint

#endif
