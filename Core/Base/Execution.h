// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace isopoint
{

/// Processes the items [begin, end).
using RangeTask = std::function<void(std::size_t begin, std::size_t end)>;

/// Calls the task, in any order and from any thread, on consecutive ranges that together cover [0,
/// count); all but the last have at least `grain` items. Returns when all calls have returned.
using ParallelFor =
  std::function<void(std::size_t count, std::size_t grain, const RangeTask& task)>;

/// Thrown when `Execution::isAborted` returns true.
struct Aborted : std::runtime_error
{
  Aborted()
    : std::runtime_error("aborted")
  {
  }
};

/// How a computation runs: its threads, and handlers of progress and abort. The defaults run in the
/// calling thread and report nothing. Results do not depend on it.
struct Execution
{
  ParallelFor parallelFor = [](std::size_t count, std::size_t, const RangeTask& task)
  { task(0, count); };

  /// Number of ranges that `parallelFor` works on at the same time, at least 1.
  std::size_t threads = 1;

  /// Called from the calling thread with the share of the work that is done, in [0, 1].
  std::function<void(double fraction)> progress = [](double) {};

  /// Called from the calling thread every few tens of milliseconds. Returns whether to stop.
  std::function<bool()> isAborted = []() { return false; };
};

/// A copy whose progress from 0 to 1 maps to [begin, end] of the original's.
inline Execution partOf(const Execution& execution, double begin, double end)
{
  Execution part = execution;
  part.progress = [whole = execution.progress, begin, end](double fraction)
  { whole(begin + fraction * (end - begin)); };
  return part;
}

/// A copy whose progress never decreases, even if work is repeated.
inline Execution withRisingProgress(const Execution& execution)
{
  Execution rising = execution;
  rising.progress = [whole = execution.progress, highest = std::make_shared<double>(0.0)](
                      double fraction)
  {
    *highest = std::max(*highest, fraction);
    whole(*highest);
  };
  return rising;
}

inline void throwIfAborted(const Execution& execution)
{
  if (execution.isAborted())
  {
    throw Aborted();
  }
}

/// Runs the task over [0, count); see ParallelFor. Exceptions must not cross the scheduler: after
/// one, skips the ranges that have not begun, and rethrows it here.
inline void forRanges(
  const Execution& execution, std::size_t count, std::size_t grain, const RangeTask& task)
{
  if (count == 0)
  {
    return;
  }
  std::exception_ptr failure;
  std::mutex failureMutex;
  std::atomic<bool> failed{ false };
  execution.parallelFor(count, grain,
    [&](std::size_t begin, std::size_t end)
    {
      if (failed)
      {
        return;
      }
      try
      {
        task(begin, end);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(failureMutex);
        failure = failure ? failure : std::current_exception();
        failed = true;
      }
    });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

/// Called after each batch with the share of the items that are done.
using BatchDone = std::function<void(double share)>;

/// A default BatchDone. Not a lambda, whose name would differ among source files: some would not
/// link.
inline void ignoreShare(double /*share*/) {}

/// forRanges() in batches; checks for an abort after each one.
/// @param batchPerThread items of a batch per thread
/// @throws Aborted, and whatever `task` throws
inline void forBatches(const Execution& execution, std::size_t count, std::size_t batchPerThread,
  std::size_t grain, const RangeTask& task, const BatchDone& batchDone = ignoreShare)
{
  const std::size_t batch = batchPerThread * execution.threads;
  for (std::size_t done = 0; done < count; done += batch)
  {
    forRanges(execution, std::min(batch, count - done), grain,
      [&](std::size_t begin, std::size_t end) { task(done + begin, done + end); });
    throwIfAborted(execution);
    batchDone(std::min(1.0, static_cast<double>(done + batch) / static_cast<double>(count)));
  }
}

/// Calls work(item), which takes at most microseconds, for the items 0 .. count - 1, from any
/// thread.
/// @throws Aborted, and whatever `work` throws
template <class Work>
void forEachIndex(const Execution& execution, std::size_t count, const Work& work,
  const BatchDone& batchDone = ignoreShare)
{
  constexpr std::size_t grain = 4096;
  forBatches(
    execution, count, 4 * grain, grain,
    [&work](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        work(i);
      }
    },
    batchDone);
}

/// Calls work(i) for i = 0 .. count - 1, ascending and in the calling thread, for items that depend
/// on earlier ones; checks for aborts in between.
template <class Work>
void forEachInOrder(const Execution& execution, std::size_t count, const Work& work)
{
  constexpr std::size_t batch = 4096;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i % batch == 0)
    {
      throwIfAborted(execution);
    }
    work(i);
  }
}

/// Parameters of forBatches().
struct ItemBatches
{
  std::size_t count;
  std::size_t batchPerThread;
  std::size_t grain;
};

/// Calls work(worker, item) for the items 0 .. batches.count - 1. A worker, such as scratch memory,
/// serves one thread at a time; one that throws is dropped.
/// @param makeWorker() called from any thread, when all workers are in use
/// @throws Aborted, and whatever `makeWorker` and `work` throw
template <class MakeWorker, class Work>
void forEachItem(const Execution& execution, const ItemBatches& batches,
  const MakeWorker& makeWorker, const Work& work, const BatchDone& batchDone = ignoreShare)
{
  using Worker = std::decay_t<decltype(makeWorker())>;
  std::vector<std::unique_ptr<Worker>> idle;
  std::mutex mutex;
  forBatches(
    execution, batches.count, batches.batchPerThread, batches.grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::unique_ptr<Worker> worker;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!idle.empty())
        {
          worker = std::move(idle.back());
          idle.pop_back();
        }
      }
      if (!worker)
      {
        worker.reset(new Worker(makeWorker()));
      }
      for (std::size_t i = begin; i < end; ++i)
      {
        work(*worker, i);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(worker));
    },
    batchDone);
}

} // namespace isopoint
