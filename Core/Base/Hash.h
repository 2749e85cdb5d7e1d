// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace isopoint
{

/// The bits of a number.
inline std::uint64_t bitsOf(double number)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits;
}

/// A permutation of 64 bits in which every bit depends on all others (finalizer of SplitMix64).
inline std::uint64_t mixBits(std::uint64_t number)
{
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
  number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
  return number ^ (number >> 31);
}

/// The hash of a sequence, extended by one number.
inline std::uint64_t extendedHash(std::uint64_t hash, std::uint64_t number)
{
  return mixBits((hash ^ number) + 0x9e3779b97f4a7c15u);
}

/// A hash of numbers. It differs if one of them differs; if several do, it is equal once in 2^64.
inline std::uint64_t hashOf(const std::uint64_t* numbers, std::size_t count)
{
  return std::accumulate(numbers, numbers + count, std::uint64_t{ count }, extendedHash);
}

/// A hash of a cell in one of several grids.
/// @param cell integers, which may exceed the range of integer types
inline std::uint64_t hashOfCell(int grid, const std::array<double, 3>& cell)
{
  auto hash = static_cast<std::uint64_t>(grid);
  for (const double coordinate : cell)
  {
    hash = extendedHash(hash, bitsOf(coordinate + 0.0)); // -0 becomes 0
  }
  return hash;
}

/// A hash of bytes and their number with the same properties, computed on all threads. O(bytes)
/// @throws Aborted, std::bad_alloc
inline std::uint64_t hashOf(
  const Execution& execution, const unsigned char* bytes, std::size_t count)
{
  constexpr std::size_t hashed = std::size_t{ 1 } << 16; // bytes in one part
  constexpr std::size_t numbers = hashed / sizeof(std::uint64_t);
  std::vector<std::uint64_t> parts((count + hashed - 1) / hashed);
  forBatches(execution, parts.size(), 64, 1,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::uint64_t> part(numbers);
      for (std::size_t i = begin; i < end; ++i)
      {
        std::fill(part.begin(), part.end(), 0);
        std::memcpy(part.data(), bytes + i * hashed, std::min(hashed, count - i * hashed));
        parts[i] = hashOf(part.data(), numbers);
      }
    });
  return extendedHash(hashOf(parts.data(), parts.size()), count); // the last part is padded
}

} // namespace isopoint
