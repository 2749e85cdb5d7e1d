// SPDX-License-Identifier: GPL-3.0-or-later
// The filter's own threads: where one cannot be started the others do its work, and no thread
// outlives an exception.
#include "FailingAllocator.h"
#include "Update/vtkIsopointExecution.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

namespace
{

constexpr std::size_t threads = 4;
constexpr std::size_t count = 1003;
constexpr std::size_t grain = 10;

/// Counts how often each item is processed while the n-th allocation of any size fails. More
/// threads than in other tests, since the system reuses the memory of threads that ended.
/// @returns the number of allocations
long countVisits(std::vector<std::atomic<int>>& visits, long n, bool andAllLater)
{
  const isopoint::RangeTask task = [&visits](std::size_t begin, std::size_t end)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      ++visits[i];
    }
  };
  failingallocator::failAt(n, andAllLater, 0);
  vtkForIsopointRanges(2 * threads, count, grain, task);
  return failingallocator::stop();
}

} // namespace

TEST(Threads, EachItemIsProcessedOnce)
{
  for (const std::size_t items : { 0u, 1u, 10u, 11u, 1003u })
  {
    std::vector<std::atomic<int>> visits(items);
    vtkForIsopointRanges(threads, items, grain,
      [&visits](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          ++visits[i];
        }
      });
    for (const std::atomic<int>& visit : visits)
    {
      ASSERT_EQ(visit, 1);
    }
  }
}

TEST(Threads, IfMemoryForAThreadIsLackingTheOthersDoTheWork)
{
  for (const bool andAllLater : { false, true })
  {
    bool failed = true;
    long n = 1;
    for (; failed; ++n)
    {
      SCOPED_TRACE(testing::Message() << "allocation " << n << (andAllLater ? " and later" : ""));
      ASSERT_LT(n, 1000);
      std::vector<std::atomic<int>> visits(count);
      failed = countVisits(visits, n, andAllLater) >= n;
      for (const std::atomic<int>& visit : visits)
      {
        ASSERT_EQ(visit, 1);
      }
    }
    EXPECT_GT(n, static_cast<long>(2 * threads)); // the list of threads, and each but the first
  }
}

TEST(Threads, AnExceptionInTheCallingThreadIsThrownAfterTheOthersHaveEnded)
{
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> thrown{ false };
  std::atomic<int> running{ 0 };
  const auto task = [&](std::size_t, std::size_t)
  {
    if (std::this_thread::get_id() == caller)
    {
      thrown = true;
      throw std::runtime_error("");
    }
    ++running;
    while (!thrown)
    {
      std::this_thread::yield();
    }
    --running;
  };
  EXPECT_THROW(vtkForIsopointRanges(threads, count, grain, task), std::runtime_error);
  EXPECT_EQ(running, 0);
}
