// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Partition_h
#define isopoint_Partition_h

#include "Isopoint/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// How many elements of either range are in order, from its beginning.
struct ExchangeProgress
{
  std::size_t lowerDone;
  std::size_t upperDone;
};

/// Swaps what does not belong to `lower` with what does not belong to `upper` until one of the
/// two is in order, in place. Misplaced elements are listed a block at a time without a branch on
/// the comparison [EW16], which at a median split no branch predictor could foresee.
/// @param belongsLower whether an element belongs to the lower range
template <class T, class Predicate>
ExchangeProgress exchangeMisplaced(
  T* lower, std::size_t lowerCount, T* upper, std::size_t upperCount, const Predicate& belongsLower)
{
  constexpr std::size_t blockSize = 128;
  struct Side
  {
    std::uint8_t misplaced[blockSize];
    std::size_t next = 0;  // of the misplaced ones listed
    std::size_t end = 0;   // of the list
    std::size_t block = 0; // where the listed block begins
    std::size_t scanned = 0;

    std::size_t done() const
    {
      return this->next < this->end ? this->block + this->misplaced[this->next] : this->scanned;
    }
  };
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
      return { low.done(), high.done() };
    }
    for (std::size_t pair = 0; pair < pairs; ++pair)
    {
      std::swap(lower[low.block + low.misplaced[low.next++]],
        upper[high.block + high.misplaced[high.next++]]);
    }
  }
}

/// Partitions elements of which exactly `lowerCount` belong lower, with every thread: each takes
/// one slice of both halves. What a slice cannot balance within itself, which is little unless the
/// cloud is in a particular order, the calling thread exchanges afterwards.
template <class T, class Predicate>
void partitionTogether(const Execution& execution, T* elements, std::size_t count,
  std::size_t lowerCount, const Predicate& belongsLower)
{
  struct Slice
  {
    T* lower;
    T* lowerEnd;
    T* upper;
    T* upperEnd;
  };
  const std::size_t upperCount = count - lowerCount;
  const std::size_t sliceCount = 4 * execution.threads;
  std::vector<Slice> slices(sliceCount);
  for (std::size_t i = 0; i < sliceCount; ++i)
  {
    slices[i].lower = elements + lowerCount * i / sliceCount;
    slices[i].lowerEnd = elements + lowerCount * (i + 1) / sliceCount;
    slices[i].upper = elements + lowerCount + upperCount * i / sliceCount;
    slices[i].upperEnd = elements + lowerCount + upperCount * (i + 1) / sliceCount;
  }
  forRanges(execution, sliceCount, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        Slice& slice = slices[i];
        const ExchangeProgress progress = exchangeMisplaced(slice.lower,
          slice.lowerEnd - slice.lower, slice.upper, slice.upperEnd - slice.upper, belongsLower);
        slice.lower += progress.lowerDone;
        slice.upper += progress.upperDone;
      }
    });

  std::size_t low = 0;
  std::size_t high = 0;
  while (low < sliceCount && high < sliceCount)
  {
    const ExchangeProgress progress =
      exchangeMisplaced(slices[low].lower, slices[low].lowerEnd - slices[low].lower,
        slices[high].upper, slices[high].upperEnd - slices[high].upper, belongsLower);
    slices[low].lower += progress.lowerDone;
    slices[high].upper += progress.upperDone;
    low += slices[low].lower == slices[low].lowerEnd ? 1 : 0;
    high += slices[high].upper == slices[high].upperEnd ? 1 : 0;
  }
}

} // namespace isopoint

#endif
