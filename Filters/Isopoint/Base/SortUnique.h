// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SortUnique_h
#define isopoint_SortUnique_h

#include "Isopoint/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// The same with every thread: they are distributed over buckets
/// by their key, and the buckets are sorted independently.
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
  const auto bucketOf = [&](const T& element) { return key(element) / keysPerBucket; };

  std::vector<std::size_t> ends(bucketCount + 1, 0);
  for (const T& element : elements)
  {
    ++ends[bucketOf(element) + 1];
  }
  for (std::size_t bucket = 0; bucket < bucketCount; ++bucket)
  {
    ends[bucket + 1] += ends[bucket];
  }
  std::vector<std::size_t> begins(ends.begin(), ends.end() - 1);
  std::vector<T> dealt(elements.size());
  for (const T& element : elements)
  {
    dealt[begins[bucketOf(element)]++] = element;
  }

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
