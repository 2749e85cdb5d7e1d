// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <map>
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
  std::size_t operator[](std::size_t i) const { return this->first[i]; }
};

/// 0, ..., count - 1.
inline std::vector<std::size_t> iota(std::size_t count)
{
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  return numbers;
}

/// Offsets of concatenated lists, from `first` on, and the end of the last one.
template <class T>
std::vector<std::size_t> offsetsOf(const std::vector<std::vector<T>>& lists, std::size_t first = 0)
{
  std::vector<std::size_t> begins(1, first);
  begins.reserve(lists.size() + 1);
  for (const std::vector<T>& list : lists)
  {
    begins.push_back(begins.back() + list.size());
  }
  return begins;
}

/// Offsets of concatenated lists, and the end of the last one.
/// @param sizeOf(list) called from any thread; takes at most microseconds
/// @throws Aborted, std::bad_alloc, and whatever `sizeOf` throws
template <class SizeOf>
std::vector<std::size_t> offsetsFromSizes(
  const Execution& execution, std::size_t listCount, const SizeOf& sizeOf)
{
  std::vector<std::size_t> begins(listCount + 1, 0);
  forEachIndex(execution, listCount, [&](std::size_t i) { begins[i + 1] = sizeOf(i); });
  forEachInOrder(execution, listCount, [&](std::size_t i) { begins[i + 1] += begins[i]; });
  return begins;
}

/// Calls work(list) for the index of each list, from any thread; groups short lists.
/// @param begins offsets from offsetsOf()
/// @throws Aborted, and whatever `work` throws
template <class Work>
void forEachList(
  const Execution& execution, const std::vector<std::size_t>& begins, const Work& work)
{
  constexpr std::size_t few = 65536; // elements that are not worth a thread
  const std::size_t count = begins.size() - 1;
  const std::size_t grain = few * count / (begins.back() - begins.front() + 1) + 1;
  forBatches(execution, count, 8 * grain, grain,
    [&work](std::size_t begin, std::size_t end)
    {
      for (std::size_t list = begin; list < end; ++list)
      {
        work(list);
      }
    });
}

/// Concatenates lists. @throws Aborted, std::bad_alloc
/// @param begins offsets from offsetsOf()
template <class T>
std::vector<T> joined(const Execution& execution, const std::vector<std::vector<T>>& lists,
  const std::vector<std::size_t>& begins)
{
  std::vector<T> all(begins.back());
  forEachList(execution, begins,
    [&](std::size_t i) { std::copy(lists[i].begin(), lists[i].end(), all.data() + begins[i]); });
  return all;
}

/// The elements found in ranges of items, in the order of the ranges.
/// @param collect(begin, end, found) appends the elements of a range; called from any thread
/// @throws Aborted, std::bad_alloc, and whatever `collect` throws
template <class T, class Collect>
std::vector<T> collected(const Execution& execution, const ItemBatches& batches,
  const Collect& collect, const BatchDone& batchDone = ignoreShare)
{
  std::map<std::size_t, std::vector<T>> lists; // by the first item of their range
  std::mutex mutex;
  forBatches(
    execution, batches.count, batches.batchPerThread, batches.grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<T> found;
      collect(begin, end, found);
      if (!found.empty())
      {
        const std::lock_guard<std::mutex> lock(mutex);
        lists.emplace(begin, std::move(found));
      }
    },
    batchDone);
  std::vector<std::vector<T>> inOrder;
  inOrder.reserve(lists.size());
  for (auto& [begin, list] : lists)
  {
    inOrder.push_back(std::move(list));
  }
  return joined(execution, inOrder, offsetsOf(inOrder));
}

/// The elements found at the items 0 .. count - 1, in their order.
/// @param collect(item, found) appends the elements of an item; called from any thread, takes at
/// most microseconds
/// @throws Aborted, std::bad_alloc, and whatever `collect` throws
template <class T, class Collect>
std::vector<T> collectedFromEach(const Execution& execution, std::size_t count,
  const Collect& collect, const BatchDone& batchDone = ignoreShare)
{
  constexpr std::size_t grain = 4096;
  return collected<T>(
    execution, { count, 4 * grain, grain },
    [&collect](std::size_t begin, std::size_t end, std::vector<T>& found)
    {
      for (std::size_t item = begin; item < end; ++item)
      {
        collect(item, found);
      }
    },
    batchDone);
}

/// valueOf(0), ..., valueOf(count - 1).
/// @param valueOf(item) called from any thread; takes at most microseconds
/// @throws Aborted, std::bad_alloc, and whatever `valueOf` throws
template <class T, class ValueOf>
std::vector<T> tabulated(const Execution& execution, std::size_t count, const ValueOf& valueOf)
{
  std::vector<T> values(count);
  forEachIndex(execution, count, [&](std::size_t item) { values[item] = valueOf(item); });
  return values;
}

/// The ascending items 0 .. count - 1 that pass a test.
/// @param isWanted(item) called from any thread; takes at most microseconds
/// @throws Aborted, std::bad_alloc, and whatever `isWanted` throws
template <class IsWanted>
std::vector<std::size_t> itemsThat(
  const Execution& execution, std::size_t count, const IsWanted& isWanted)
{
  return collectedFromEach<std::size_t>(execution, count,
    [&isWanted](std::size_t item, std::vector<std::size_t>& found)
    {
      if (isWanted(item))
      {
        found.push_back(item);
      }
    });
}

/// The ascending items 0 .. count - 1 that pass a test which may need samples of other ranks.
/// Collective.
/// @param ranks SingleRank or SharedRanks
template <class TRanks, class IsWanted>
std::vector<std::size_t> itemsThat(const Execution& execution, TRanks& ranks, std::size_t count,
  const IsWanted& isWanted, const BatchDone& batchDone = ignoreShare)
{
  constexpr std::size_t grain = 256;
  std::vector<char> marks(count, 0);
  ranks.forEach(
    execution, { count, 8 * grain, grain }, []() { return 0; },
    [&](int, std::size_t i) { marks[i] = isWanted(i) ? 1 : 0; }, batchDone);
  return itemsThat(execution, count, [&marks](std::size_t i) { return marks[i] != 0; });
}

/// all[i] for each index i. @throws std::bad_alloc, Aborted
/// @param all if empty, so is the result
template <class T>
std::vector<T> chosenOf(
  const Execution& execution, const std::vector<T>& all, const std::vector<std::size_t>& indices)
{
  if (all.empty())
  {
    return {};
  }
  return tabulated<T>(execution, indices.size(), [&](std::size_t i) { return all[indices[i]]; });
}

/// The elements that pass a test, in their order. @throws Aborted, std::bad_alloc
/// @param isWanted(element) called from any thread; takes at most microseconds
template <class T, class IsWanted>
std::vector<T> chosenThat(
  const Execution& execution, const std::vector<T>& all, const IsWanted& isWanted)
{
  return chosenOf(execution, all,
    itemsThat(execution, all.size(), [&](std::size_t i) { return isWanted(all[i]); }));
}

/// Chooses lists from concatenated ones.
/// @param begins offsets of all lists, and the end of the last one; if empty, so is the result
/// @param elements receives the element indices of the chosen lists
/// @returns offsets of the chosen lists, and the end of the last one
/// @throws std::bad_alloc, Aborted
inline std::vector<std::size_t> chosenLists(const Execution& execution,
  const std::vector<std::size_t>& begins, const std::vector<std::size_t>& indices,
  std::vector<std::size_t>& elements)
{
  if (begins.empty())
  {
    return {};
  }
  std::vector<std::size_t> chosen(1, 0);
  chosen.reserve(indices.size() + 1);
  forEachInOrder(execution, indices.size(),
    [&](std::size_t i)
    {
      for (std::size_t k = begins[indices[i]]; k < begins[indices[i] + 1]; ++k)
      {
        elements.push_back(k);
      }
      chosen.push_back(elements.size());
    });
  return chosen;
}

/// The items with each key, such as the triangles at each vertex: contiguous lists, each ascending.
class ItemLists
{
public:
  /// O(keys + items), in the calling thread
  /// @param keysOf(item) the item's keys, each once and below keyCount; called twice
  /// @throws Aborted, std::bad_alloc
  template <class KeysOf>
  ItemLists(
    const Execution& execution, std::size_t keyCount, std::size_t itemCount, const KeysOf& keysOf)
    : Begins(keyCount + 1)
  {
    forEachInOrder(execution, itemCount,
      [&](std::size_t item)
      {
        for (const auto key : keysOf(item))
        {
          ++this->Begins[key];
        }
      });
    std::size_t end = 0;
    forEachInOrder(execution, this->Begins.size(),
      [&](std::size_t key) { this->Begins[key] = end += this->Begins[key]; });
    this->Items.resize(end);
    forEachInOrder(execution, itemCount,
      [&](std::size_t i)
      {
        const std::size_t item = itemCount - 1 - i;
        for (const auto key : keysOf(item))
        {
          this->Items[--this->Begins[key]] = item;
        }
      });
  }

  IndexSpan<std::size_t> at(std::size_t key) const
  {
    const std::size_t begin = this->Begins[key];
    return { this->Items.data() + begin, this->Begins[key + 1] - begin };
  }

  /// Moves out all lists, concatenated.
  std::vector<std::size_t> all() && { return std::move(this->Items); }

private:
  std::vector<std::size_t> Begins; // by key; last, the end of the last list
  std::vector<std::size_t> Items;
};

/// The ascending indices of marks that are set. @throws Aborted, std::bad_alloc
template <class TMark>
std::vector<std::size_t> markedOf(const Execution& execution, const std::vector<TMark>& marks)
{
  return itemsThat(execution, marks.size(), [&marks](std::size_t i) { return bool(marks[i]); });
}

/// Removes the marked elements. @throws Aborted, std::bad_alloc
template <class T>
void dropMarked(const Execution& execution, const std::vector<char>& marks, std::vector<T>& all)
{
  all = chosenOf(execution, all,
    itemsThat(execution, all.size(), [&marks](std::size_t i) { return marks[i] == 0; }));
}

template <class T>
void keepUnique(std::vector<T>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The inverse of an order: the index at which it has each number; undefined for numbers it lacks.
/// @param order has each number at most once
/// @param count exceeds all numbers
/// @throws Aborted, std::bad_alloc
inline std::vector<std::size_t> inverseOf(
  const Execution& execution, const std::vector<std::size_t>& order, std::size_t count)
{
  std::vector<std::size_t> inverse(count);
  forEachIndex(execution, order.size(), [&](std::size_t i) { inverse[order[i]] = i; });
  return inverse;
}

} // namespace isopoint
