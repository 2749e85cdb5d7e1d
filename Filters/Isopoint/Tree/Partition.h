// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Partition_h
#define isopoint_Partition_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace isopoint
{

/// Partitions elements of which exactly `lowerCount` belong lower, in place: swaps what is
/// misplaced on either side. It is listed a block at a time without a branch on the comparison
/// [EW16], which at a median split no branch predictor could foresee.
/// @param belongsLower whether an element belongs among the first `lowerCount`
template <class T, class Predicate>
void exchangeMisplaced(
  T* lower, std::size_t count, std::size_t lowerCount, const Predicate& belongsLower)
{
  constexpr std::size_t blockSize = 128;
  struct Side
  {
    std::uint8_t misplaced[blockSize];
    std::size_t next = 0;  // of the misplaced ones listed
    std::size_t end = 0;   // of the list
    std::size_t block = 0; // where the listed block begins
    std::size_t scanned = 0;
  };
  T* const upper = lower + lowerCount;
  const std::size_t upperCount = count - lowerCount;
  const auto list = [blockSize](Side& side, std::size_t count, const auto& isMisplaced)
  {
    side.block = side.scanned;
    side.next = 0;
    side.end = 0;
    const std::size_t length = std::min(blockSize, count - side.block);
    for (std::size_t i = 0; i < length; ++i)
    {
      side.misplaced[side.end] = static_cast<std::uint8_t>(i);
      side.end += isMisplaced(side.block + i) ? 1 : 0;
    }
    side.scanned += length;
  };

  Side low;
  Side high;
  for (;;)
  {
    while (low.next == low.end && low.scanned < lowerCount)
    {
      list(low, lowerCount, [&](std::size_t i) { return !belongsLower(lower[i]); });
    }
    while (high.next == high.end && high.scanned < upperCount)
    {
      list(high, upperCount, [&](std::size_t i) { return belongsLower(upper[i]); });
    }
    const std::size_t pairs = std::min(low.end - low.next, high.end - high.next);
    if (pairs == 0)
    {
      return;
    }
    for (std::size_t pair = 0; pair < pairs; ++pair)
    {
      std::swap(lower[low.block + low.misplaced[low.next++]],
        upper[high.block + high.misplaced[high.next++]]);
    }
  }
}

} // namespace isopoint

#endif
