// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Hash_h
#define isopoint_Hash_h

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace isopoint
{

/// A hash of numbers that changing one of them always changes, and changing several all but surely.
inline std::uint64_t hashOf(const std::uint64_t* numbers, std::size_t count)
{
  std::uint64_t hash = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    // Products carry upwards alone; shifts bring changes down again.
    hash = (hash ^ numbers[i]) * 11400714819323198485u; // 2^64 over the golden ratio
    hash = (hash ^ hash >> 29) * 11400714819323198485u;
    hash ^= hash >> 32;
  }
  return hash;
}

/// A hash of bytes, likewise, on all threads. O(bytes)
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
  return hashOf(parts.data(), parts.size());
}

} // namespace isopoint

#endif
