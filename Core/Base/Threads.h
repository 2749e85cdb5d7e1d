// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"

// Defined by CGAL if oneTBB is available. The thread sanitizer cannot follow oneTBB.
#if defined(CGAL_LINKED_WITH_TBB) && !defined(__SANITIZE_THREAD__)
#define ISOPOINT_USES_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#ifndef _WIN32
#include <pthread.h>
#endif
#ifdef __linux__
#include <sched.h>
#include <unistd.h>
#endif

namespace isopoint
{

/// The cores granted by the CPU quota of a Linux control group (version 2 or 1), rounded up; the
/// greatest size_t without a quota.
inline std::size_t coresOfQuota(const std::string& group)
{
  double time = 0.0;
  double period = 0.0;
  const bool hasQuota = (std::ifstream(group + "/cpu.max") >> time >> period) ||
                        (std::ifstream(group + "/cpu.cfs_quota_us") >> time &&
                          std::ifstream(group + "/cpu.cfs_period_us") >> period);
  return hasQuota && time > 0.0 && period > 0.0 ? static_cast<std::size_t>(std::ceil(time / period))
                                                : std::numeric_limits<std::size_t>::max();
}

/// The least quota of this process's control groups and their ancestors, such as a container's.
inline std::size_t coresOfQuota()
{
  std::size_t cores = std::numeric_limits<std::size_t>::max();
  std::ifstream groups("/proc/self/cgroup"); // each line: number:controllers:path
  for (std::string line; std::getline(groups, line);)
  {
    const std::size_t begin = line.find(':') + 1;
    const std::size_t end = line.find(':', begin);
    const std::string controllers = line.substr(begin, end - begin);
    const bool isVersion2 = controllers.empty();
    if (!isVersion2 && (',' + controllers + ',').find(",cpu,") == std::string::npos)
    {
      continue;
    }
    const std::string root = isVersion2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/cpu";
    std::string path = line.substr(end + 1);
    while (!path.empty() && path.front() == '/')
    {
      cores = std::min(cores, coresOfQuota(root + path));
      path.erase(path.rfind('/'));
    }
    cores = std::min(cores, coresOfQuota(root));
  }
  return cores;
}

/// Threads of this process that can run at the same time: the cores it is bound to, within the
/// quota of its container, divided by the number of processes that share them. At least 1.
inline std::size_t availableThreads(std::size_t processes = 1)
{
  std::size_t cores = std::thread::hardware_concurrency();
#ifdef __linux__
  cpu_set_t bound;
  if (sched_getaffinity(0, sizeof(bound), &bound) == 0)
  {
    cores = static_cast<std::size_t>(CPU_COUNT(&bound));
  }
#endif
  static const std::size_t quota = coresOfQuota();
  return std::max<std::size_t>(1, std::min(cores, quota) / processes);
}

/// The cores that this process is bound to, as a key that is equal for processes that share them.
inline std::string boundCores()
{
#ifdef __linux__
  cpu_set_t bound;
  if (sched_getaffinity(0, sizeof(bound), &bound) == 0)
  {
    return std::string(reinterpret_cast<const char*>(&bound), sizeof(bound));
  }
#endif
  return {};
}

/// Threads of this process without communication: if an MPI launcher started several unbound ranks
/// on this host, this rank's share of all cores. At least 1.
inline std::size_t availableThreadsOfRank()
{
  std::size_t threads = availableThreads();
#ifdef __linux__
  for (const char* const count : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" })
  {
    const char* const ranks = std::getenv(count);
    const long parsed = ranks ? std::strtol(ranks, nullptr, 10) : 0;
    if (parsed > 0)
    {
      threads = std::min(threads, static_cast<std::size_t>(sysconf(_SC_NPROCESSORS_ONLN) / parsed));
    }
  }
#endif
  return std::max<std::size_t>(1, threads);
}

#ifdef ISOPOINT_USES_TBB

constexpr bool hasThreads = true;

/// Whether this process was forked from one that used oneTBB: it has none of its threads, and
/// perhaps their locks.
inline std::atomic<bool>& isForkOfThreads()
{
  static std::atomic<bool> isFork{ false };
  return isFork;
}

/// To be called before oneTBB is used, for isForkOfThreads().
inline void watchForksOfThreads()
{
#ifndef _WIN32
  static const int watched = pthread_atfork(nullptr, nullptr, []() { isForkOfThreads() = true; });
  static_cast<void>(watched);
#endif
}

/// Makes an execution run on at most `threads` threads of oneTBB, including the calling one. If the
/// system grants fewer, these do all the work. Once oneTBB failed to start, and in a process forked
/// from one that used it, only the calling thread works, since oneTBB would hang. Tasks must not
/// throw; forRanges() ensures this.
inline void useThreads(Execution& execution, std::size_t threads)
{
  static std::atomic<bool> hasFailed{ false };
  std::shared_ptr<tbb::task_arena> arena;
  try
  {
    if (hasFailed || isForkOfThreads())
    {
      return;
    }
    watchForksOfThreads();
    threads = std::min(
      threads, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    arena = std::shared_ptr<tbb::task_arena>(new tbb::task_arena(static_cast<int>(threads)),
      [](tbb::task_arena* ended)
      {
        if (!isForkOfThreads())
        {
          delete ended;
        }
      });
  }
  catch (const std::exception&)
  {
    hasFailed = true;
    return;
  }
  execution.threads = threads;
  execution.parallelFor = [arena, most = execution.threads](
                            std::size_t count, std::size_t grain, const RangeTask& task)
  {
    std::atomic<std::size_t> next{ 0 };
    const auto work = [&]()
    {
      for (std::size_t begin = next.fetch_add(grain); begin < count; begin = next.fetch_add(grain))
      {
        task(begin, std::min(begin + grain, count));
      }
    };
    if (isForkOfThreads())
    {
      return work();
    }
    try
    {
      const std::size_t workers = std::min(most, (count + grain - 1) / grain);
      arena->execute(
        [&]()
        {
          tbb::parallel_for(
            std::size_t{ 0 }, workers, [&work](std::size_t) { work(); }, tbb::simple_partitioner());
        });
    }
    catch (const std::exception&)
    {
      // No thread could be started: the calling thread does the rest.
    }
    work();
  };
}

#else

constexpr bool hasThreads = false;

inline void useThreads(Execution&, std::size_t) {}

#endif

} // namespace isopoint
