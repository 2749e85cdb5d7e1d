// SPDX-License-Identifier: GPL-3.0-or-later
// Threads: if one cannot start, the others do its work; all stay within the quota of a container.
#include "FailingAllocator.h"

#include "Core/Base/Threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{

constexpr std::size_t threads = 8;
constexpr std::size_t grain = 10;

isopoint::Execution threadedExecution()
{
  isopoint::Execution execution;
  isopoint::useThreads(execution, threads);
  return execution;
}

/// Expects that each item is processed once while this allocation (from 1) and all later ones fail.
void expectOneVisitEach(std::size_t items, long failing)
{
  const isopoint::Execution execution = threadedExecution();
  std::vector<std::atomic<int>> visits(items);
  const isopoint::RangeTask task = [&visits](std::size_t begin, std::size_t end)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      ++visits[i];
    }
  };
  failingallocator::failAt(failing, true, 0);
  execution.parallelFor(items, grain, task);
  failingallocator::stop();
  for (const std::atomic<int>& visit : visits)
  {
    ASSERT_EQ(visit, 1);
  }
}

} // namespace

TEST(Threads, EachItemIsProcessedOnce)
{
  for (const std::size_t items : { 0u, 1u, 10u, 11u, 1003u })
  {
    expectOneVisitEach(items, 1000000000); // none fails
  }
  for (long n = 1; n < 20; ++n) // memory for a thread is lacking: the others do the work
  {
    SCOPED_TRACE(testing::Message() << "allocation " << n << " and later");
    expectOneVisitEach(1003, n);
  }
}

TEST(Threads, AnExceptionOfATaskIsThrownInTheCallingThread)
{
  EXPECT_THROW(isopoint::forRanges(threadedExecution(), 1003, grain,
                 [](std::size_t begin, std::size_t)
                 {
                   if (begin == 500)
                   {
                     throw std::runtime_error("");
                   }
                 }),
    std::runtime_error);
}

TEST(Threads, AQuotaOfAContainerIsKept)
{
  const std::filesystem::path group =
    std::filesystem::temp_directory_path() / ("TestThreadsQuota" + std::to_string(getpid()));
  std::filesystem::create_directory(group);
  const auto coresWith = [&](const char* file, const char* text)
  {
    std::ofstream(group / file) << text << '\n';
    return isopoint::coresOfQuota(group);
  };
  EXPECT_GT(coresWith("cpu.max", "max 100000"), 1000000u);
  EXPECT_EQ(coresWith("cpu.max", "250000 100000"), 3u);
  std::filesystem::remove(group / "cpu.max");
  coresWith("cpu.cfs_period_us", "100000");
  EXPECT_GT(coresWith("cpu.cfs_quota_us", "-1"), 1000000u);
  EXPECT_EQ(coresWith("cpu.cfs_quota_us", "200000"), 2u);
  std::filesystem::remove_all(group);
}
