// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Collected_h
#define isopoint_Collected_h

#include "Core/Base/Execution.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace isopoint
{

/// Where lists begin that follow each other, and the end of the last one.
/// @param first where the first one begins
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

/// Work on lists that follow each other, short ones many at a time.
/// @param begins of the lists, as beginsOf() returns them
/// @param work(list) from any thread
/// @throws what the work throws
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

/// Lists, one after the other. @throws std::bad_alloc
/// @param begins of the lists, as beginsOf() returns them
template <class T>
std::vector<T> joined(const Execution& execution, const std::vector<std::vector<T>>& lists,
  const std::vector<std::size_t>& begins)
{
  std::vector<T> all(begins.back());
  forEachList(execution, begins,
    [&](std::size_t i) { std::copy(lists[i].begin(), lists[i].end(), all.data() + begins[i]); });
  return all;
}

/// What ranges of items yield together, in any order.
/// @param collect(begin, end, found) appends what a range yields; from any thread
/// @throws Aborted, std::bad_alloc, and what collecting throws
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

} // namespace isopoint

#endif
