// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SortUnique_h
#define isopoint_SortUnique_h

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// The numbers of what is marked, ascending.
/// @param marks of characters or truth values
template <class TMark>
std::vector<std::size_t> markedOf(const std::vector<TMark>& marks)
{
  std::vector<std::size_t> marked;
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    if (marks[i])
    {
      marked.push_back(i);
    }
  }
  return marked;
}

/// Sorts the elements and drops repeated ones.
template <class T>
void keepUnique(std::vector<T>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The same on all threads: elements are distributed over buckets by their key, and the buckets are
/// sorted independently of each other.
/// @param key(element) a number below keyCount, monotonic in the elements' order
/// @throws Aborted, std::bad_alloc
/// Complexity: O(n log n)
template <class T, class Key>
std::vector<T> sortedUnique(const Execution& execution, const std::vector<T>& elements,
  std::uint64_t keyCount, const Key& key)
{
  const std::size_t bucketCount =
    std::min<std::size_t>(elements.size() / 2048 + 1, 64 * execution.threads);
  const std::uint64_t keysPerBucket = keyCount / bucketCount + 1;
  const auto bucketOf = [&](const T& element)
  { return static_cast<std::size_t>(key(element) / keysPerBucket); };

  // Each thread counts and deals the elements of one part, which have places of their own.
  const std::size_t partCount = execution.threads;
  const auto forElements = [&](const auto& use)
  {
    forRanges(execution, partCount, 1,
      [&](std::size_t firstPart, std::size_t lastPart)
      {
        for (std::size_t part = firstPart; part < lastPart; ++part)
        {
          const std::size_t end = elements.size() * (part + 1) / partCount;
          for (std::size_t i = elements.size() * part / partCount; i < end; ++i)
          {
            use(part * bucketCount + bucketOf(elements[i]), elements[i]);
          }
        }
      });
  };
  std::vector<std::size_t> begins(partCount * bucketCount, 0);
  forElements([&](std::size_t place, const T&) { ++begins[place]; });
  std::vector<std::size_t> ends(bucketCount + 1, 0);
  for (std::size_t bucket = 0; bucket < bucketCount; ++bucket)
  {
    ends[bucket + 1] = ends[bucket];
    for (std::size_t part = 0; part < partCount; ++part)
    {
      std::size_t& begin = begins[part * bucketCount + bucket];
      ends[bucket + 1] += std::exchange(begin, ends[bucket + 1]);
    }
  }
  std::vector<T> dealt(elements.size());
  forElements([&](std::size_t place, const T& element) { dealt[begins[place]++] = element; });

  std::vector<std::size_t> counts(bucketCount);
  throwIfAborted(execution);
  forBatches(execution, bucketCount, 4, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t bucket = begin; bucket < end; ++bucket)
      {
        const auto first = dealt.begin() + static_cast<std::ptrdiff_t>(ends[bucket]);
        const auto last = dealt.begin() + static_cast<std::ptrdiff_t>(ends[bucket + 1]);
        std::sort(first, last);
        counts[bucket] = static_cast<std::size_t>(std::unique(first, last) - first);
      }
    });

  std::size_t size = 0;
  for (std::size_t bucket = 0; bucket < bucketCount; ++bucket)
  {
    const auto first = dealt.begin() + static_cast<std::ptrdiff_t>(ends[bucket]);
    std::copy(first, first + static_cast<std::ptrdiff_t>(counts[bucket]),
      dealt.begin() + static_cast<std::ptrdiff_t>(size));
    size += counts[bucket];
  }
  dealt.resize(size);
  return dealt;
}

} // namespace isopoint

#endif
