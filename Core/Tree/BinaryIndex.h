// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace isopoint
{

/// The 128-bit index of a node in the kd-tree ([RL06] section 4), whichever part of it is built: 1
/// for the root; each further bit leads to the lower (0) or upper (1) child.
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

/// The greatest depth that 128 bits can name. n distinct positions need ceil(log2 n) levels.
/// Coincident samples, which are never separated, can take up to four levels to halve a node: at
/// most 4 log2 n in all.
constexpr int maximumDepth = 127;

/// Thrown where samples need a larger tree than there can be; what() says how.
struct TreeTooLarge : std::length_error
{
  using std::length_error::length_error;
};

/// @throws TreeTooLarge: the tree would exceed maximumDepth
[[noreturn]] inline void throwTooDeep()
{
  throw TreeTooLarge("the tree is deeper than 127 levels: nested duplicate points");
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

/// The ancestor `levels` levels above a node, 0 to 127; 0 above the root.
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

/// The index of the highest set bit: floor(log2 number), for number > 0.
constexpr int highestBit(std::uint64_t number)
{
  int bit = 0;
  for (int step = 32; step > 0; step /= 2)
  {
    if (number >> step != 0)
    {
      number >>= step;
      bit += step;
    }
  }
  return bit;
}

/// Levels below the root, for node != 0.
constexpr int depthOf(const BinaryIndex& node)
{
  return node.high != 0 ? 64 + highestBit(node.high) : highestBit(node.low);
}

/// Levels of a tree that halves the samples exactly: ceil(log2 count), for count > 0.
constexpr int levelsToHalve(std::size_t count)
{
  return count > 1 ? highestBit(count - 1) + 1 : 0;
}

} // namespace isopoint
