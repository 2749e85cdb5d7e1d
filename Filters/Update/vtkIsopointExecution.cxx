// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointExecution.h"

#include "Input/vtkIsopointCompatibility.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace
{

void forOnSMPTools(std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
{
  const auto range = [&task](vtkIdType begin, vtkIdType end)
  { task(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); };
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), static_cast<vtkIdType>(grain), range);
}

/// Threads that run the same function. The destructor joins them.
class WorkerThreads
{
public:
  /// Starts this many threads, or as many as the system grants.
  template <class Work>
  WorkerThreads(std::size_t count, const Work& work)
  {
    try
    {
      this->Threads.reserve(count);
      while (this->Threads.size() < count)
      {
        this->Threads.emplace_back(work);
      }
    }
    catch (const std::system_error&)
    {
      // The system grants no more threads: those that were started do the work.
    }
    catch (const std::bad_alloc&)
    {
      // The same for a lack of memory.
    }
  }

  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  ~WorkerThreads()
  {
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }

private:
  std::vector<std::thread> Threads;
};

/// Whether the backend is sequential because VTK was built so, and not by choice.
bool isSequentialByDefault()
{
  const char* const backend = vtkSMPTools::GetBackend();
  return backend && std::strcmp(backend, "Sequential") == 0 &&
         !std::getenv("VTK_SMP_BACKEND_IN_USE");
}

std::size_t allowedThreads()
{
  std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
  if (const char* const limit = std::getenv("VTK_SMP_MAX_THREADS"))
  {
    const long parsed = std::strtol(limit, nullptr, 10);
    threads = parsed > 0 ? std::min(threads, static_cast<std::size_t>(parsed)) : threads;
  }
  const int initialized = vtkGetRequestedSMPThreads();
  return initialized > 0 ? std::min(threads, static_cast<std::size_t>(initialized)) : threads;
}

} // namespace

void vtkForIsopointRanges(
  std::size_t threads, std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
{
  if (count == 0)
  {
    return;
  }
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]()
  {
    for (std::size_t begin = next.fetch_add(grain); begin < count; begin = next.fetch_add(grain))
    {
      task(begin, std::min(begin + grain, count));
    }
  };
  const WorkerThreads workers(std::min(threads, (count + grain - 1) / grain) - 1, work);
  work();
}

isopoint::Execution vtkMakeIsopointExecution(
  vtkAlgorithm* filter, bool useAllCores, std::size_t ranksOnHost)
{
  isopoint::Execution execution;
  if (useAllCores && isSequentialByDefault())
  {
    const std::size_t threads = std::max<std::size_t>(1, allowedThreads() / ranksOnHost);
    execution.threads = threads;
    execution.parallelFor = [threads](
                              std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
    { vtkForIsopointRanges(threads, count, grain, task); };
  }
  else
  {
    execution.threads =
      static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
    execution.parallelFor = forOnSMPTools;
  }
  execution.progress = [filter](double fraction) { filter->UpdateProgress(fraction); };
  execution.aborted = [filter]() { return vtkIsAborted(filter); };
  return execution;
}
