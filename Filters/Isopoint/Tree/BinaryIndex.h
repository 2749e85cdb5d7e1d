// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_BinaryIndex_h
#define isopoint_BinaryIndex_h

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace isopoint
{

/// The binary index of a node of the kd-tree ([RL06] section 4): that of the root is 1, and each
/// further bit leads to a child, 0 to the lower and 1 to the upper one. It names a node whatever
/// part of the tree has been built.
__extension__ using BinaryIndex = unsigned __int128;

constexpr BinaryIndex rootIndex = 1;

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

/// Levels below the root. The node is not 0.
constexpr int depthOf(BinaryIndex node)
{
  constexpr int bits = 64;
  const auto high = static_cast<std::uint64_t>(node >> bits);
  return high != 0 ? 2 * bits - 1 - __builtin_clzll(high)
                   : bits - 1 - __builtin_clzll(static_cast<std::uint64_t>(node));
}

/// The levels of a tree that halves so many samples exactly: ceil(log2 count), count at least 1.
constexpr int levelsToHalve(std::size_t count)
{
  return count > 1 ? depthOf(count - 1) + 1 : 0;
}

} // namespace isopoint

#endif
