// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// A view of a list of numbers such as node indices.
template <class TId>
struct IndexSpan
{
  const TId* first = nullptr;
  std::size_t count = 0;

  bool isEmpty() const { return this->count == 0; }
  const TId* begin() const { return this->first; }
  const TId* end() const { return this->first + this->count; }
  std::size_t operator[](std::size_t i) const { return static_cast<std::size_t>(this->first[i]); }
};

/// Offsets of concatenated lists, from `first` on, and the end of the last one.
template <class T>
std::vector<std::size_t> beginsOf(const std::vector<std::vector<T>>& lists, std::size_t first = 0)
{
  std::vector<std::size_t> begins(1, first);
  begins.reserve(lists.size() + 1);
  for (const std::vector<T>& list : lists)
  {
    begins.push_back(begins.back() + list.size());
  }
  return begins;
}

/// Calls work(list) for the index of each list, from any thread; groups short lists.
/// @param begins offsets from beginsOf()
/// @throws whatever `work` throws
template <class Work>
void forEachList(
  const Execution& execution, const std::vector<std::size_t>& begins, const Work& work)
{
  constexpr std::size_t few = 65536; // elements that are not worth a thread
  const std::size_t count = begins.size() - 1;
  const std::size_t grain = few * count / (begins.back() - begins.front() + 1) + 1;
  forRanges(execution, count, grain,
    [&work](std::size_t begin, std::size_t end)
    {
      for (std::size_t list = begin; list < end; ++list)
      {
        work(list);
      }
    });
}

/// Concatenates lists. @throws std::bad_alloc
/// @param begins offsets from beginsOf()
template <class T>
std::vector<T> joined(const Execution& execution, const std::vector<std::vector<T>>& lists,
  const std::vector<std::size_t>& begins)
{
  std::vector<T> all(begins.back());
  forEachList(execution, begins,
    [&](std::size_t i) { std::copy(lists[i].begin(), lists[i].end(), all.data() + begins[i]); });
  return all;
}

/// The elements found in ranges of items, in any order.
/// @param collect(begin, end, found) appends the elements of a range; called from any thread
/// @throws Aborted, std::bad_alloc, and whatever `collect` throws
template <class T, class Collect>
std::vector<T> collected(
  const Execution& execution, const ItemBatches& batches, const Collect& collect,
  const BatchDone& batchDone = [](double) {})
{
  std::vector<std::vector<T>> lists;
  std::mutex mutex;
  forBatches(
    execution, batches.count, batches.batchPerThread, batches.grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<T> found;
      collect(begin, end, found);
      const std::lock_guard<std::mutex> lock(mutex);
      lists.push_back(std::move(found));
    },
    batchDone);
  return joined(execution, lists, beginsOf(lists));
}

/// The items at each place, such as the triangles at each vertex: contiguous lists, each ascending.
class ItemLists
{
public:
  /// O(places + items)
  /// @param placesOf(item) the item's places, each once and below placeCount; called twice
  /// @throws std::bad_alloc
  template <class PlacesOf>
  ItemLists(std::size_t placeCount, std::size_t itemCount, const PlacesOf& placesOf)
    : Begins(placeCount + 1)
  {
    for (std::size_t item = 0; item < itemCount; ++item)
    {
      for (const auto place : placesOf(item))
      {
        ++this->Begins[static_cast<std::size_t>(place)];
      }
    }
    std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
    this->Items.resize(this->Begins.back());
    for (std::size_t item = itemCount; item-- > 0;)
    {
      for (const auto place : placesOf(item))
      {
        this->Items[--this->Begins[static_cast<std::size_t>(place)]] = item;
      }
    }
  }

  IndexSpan<std::size_t> at(std::size_t place) const
  {
    const std::size_t begin = this->Begins[place];
    return { this->Items.data() + begin, this->Begins[place + 1] - begin };
  }

  /// Moves out all lists, concatenated.
  std::vector<std::size_t> all() && { return std::move(this->Items); }

private:
  std::vector<std::size_t> Begins; // by place; last, the end of the last list
  std::vector<std::size_t> Items;
};

/// The ascending indices of marks that are set.
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

template <class T>
void keepUnique(std::vector<T>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// A sorted copy without duplicates; the threads sort one bucket of keys each. O(n log n)
/// @param key(element) a number below keyCount, monotonic in the order of elements
/// @throws Aborted, std::bad_alloc
template <class T, class Key>
std::vector<T> sortedUnique(const Execution& execution, const std::vector<T>& elements,
  std::uint64_t keyCount, const Key& key)
{
  const std::size_t bucketCount =
    std::min<std::size_t>(elements.size() / 2048 + 1, 64 * execution.threads);
  const std::uint64_t keysPerBucket = keyCount / bucketCount + 1;
  const auto bucketOf = [&](const T& element)
  { return static_cast<std::size_t>(key(element) / keysPerBucket); };

  // Each thread distributes the elements of one part, which has its own place in each bucket.
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
