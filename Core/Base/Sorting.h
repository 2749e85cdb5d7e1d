// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Lists.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace isopoint
{

/// Sorts elements of which few have the same key. Reuses memory.
template <class T>
class BucketSort
{
public:
  /// O(n + keyCount) if few elements have the same key, and O(n log n)
  /// @param key(element) in [firstKey, firstKey + keyCount), monotonic in the order of elements
  template <class Key>
  void operator()(T* first, T* last, std::uint64_t firstKey, std::uint64_t keyCount, const Key& key)
  {
    const auto count = static_cast<std::size_t>(last - first);
    if (keyCount > 2 * count || count < 2)
    {
      std::sort(first, last);
      return;
    }
    this->Ends.assign(static_cast<std::size_t>(keyCount) + 1, 0);
    this->Copy.assign(first, last);
    const auto endOf = [&](const T& element) -> std::size_t&
    { return this->Ends[static_cast<std::size_t>(key(element) - firstKey) + 1]; };
    for (const T& element : this->Copy)
    {
      ++endOf(element);
    }
    std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin());
    // From the begin of each key's elements to their end.
    for (const T& element : this->Copy)
    {
      first[(&endOf(element))[-1]++] = element;
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < keyCount; ++i)
    {
      const std::size_t end = this->Ends[i];
      if (end - begin > 1)
      {
        std::sort(first + begin, first + end);
      }
      begin = end;
    }
  }

private:
  std::vector<T> Copy;
  std::vector<std::size_t> Ends;
};

/// A sorted copy without duplicates; the threads sort one bucket of keys each. O(n log n)
/// @param key(element) a number below keyCount, monotonic in the order of elements
/// @throws Aborted, std::bad_alloc
template <class T, class Key>
std::vector<T> sortedUnique(const Execution& execution, const std::vector<T>& elements,
  std::uint64_t keyCount, const Key& key)
{
  constexpr std::size_t many = 1024; // buckets or parts; between some of them aborts are noticed
  const std::size_t bucketCount = std::min(elements.size() / 2048 + 1,
    std::max(64 * execution.threads, std::min(many, elements.size() / 16384)));
  const std::uint64_t keysPerBucket = keyCount / bucketCount + 1;
  const auto bucketOf = [&](const T& element)
  { return static_cast<std::size_t>(key(element) / keysPerBucket); };

  // Each thread distributes the elements of one part, which has a slot of its own in each bucket.
  const std::size_t partCount =
    std::max(execution.threads, std::min(many, elements.size() / 131072));
  const auto forElements = [&](const auto& use)
  {
    forBatches(execution, partCount, 1, 1,
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
  forElements([&](std::size_t slot, const T&) { ++begins[slot]; });
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
  forElements([&](std::size_t slot, const T& element) { dealt[begins[slot]++] = element; });

  std::vector<std::size_t> counts(bucketCount);
  forBatches(execution, bucketCount, 4, 1,
    [&](std::size_t begin, std::size_t end)
    {
      BucketSort<T> sort;
      for (std::size_t bucket = begin; bucket < end; ++bucket)
      {
        T* const first = dealt.data() + ends[bucket];
        T* const last = dealt.data() + ends[bucket + 1];
        sort(first, last, bucket * keysPerBucket, keysPerBucket, key);
        counts[bucket] = static_cast<std::size_t>(std::unique(first, last) - first);
      }
    });

  std::size_t size = 0;
  for (std::size_t bucket = 0; bucket < bucketCount; ++bucket)
  {
    throwIfAborted(execution);
    if (size < ends[bucket])
    {
      const T* const first = dealt.data() + ends[bucket];
      std::copy(first, first + counts[bucket], dealt.data() + size);
    }
    size += counts[bucket];
  }
  dealt.resize(size);
  return dealt;
}

/// Numbers below a count, each once, ascending.
inline std::vector<std::size_t> sortedUnique(
  const Execution& execution, const std::vector<std::size_t>& numbers, std::uint64_t count)
{
  return sortedUnique(execution, numbers, count, [](std::size_t number) { return number; });
}

/// The items 0 .. count - 1 in the order of their keys, then of their numbers. O(n log n)
/// @param keyOf(item) called from any thread
/// @param leadOf(key) a number below leadCount, monotonic in the order of keys
/// @throws Aborted, std::bad_alloc
template <class KeyOf, class LeadOf>
std::vector<std::size_t> orderByKeys(const Execution& execution, std::size_t count,
  std::uint64_t leadCount, const KeyOf& keyOf, const LeadOf& leadOf)
{
  using Item = std::pair<std::decay_t<decltype(keyOf(count))>, std::size_t>;
  std::vector<Item> items =
    tabulated<Item>(execution, count, [&](std::size_t item) { return Item(keyOf(item), item); });
  items =
    sortedUnique(execution, items, leadCount, [&](const Item& item) { return leadOf(item.first); });
  return tabulated<std::size_t>(execution, count, [&](std::size_t i) { return items[i].second; });
}

} // namespace isopoint
