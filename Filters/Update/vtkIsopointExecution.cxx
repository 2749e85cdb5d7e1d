// SPDX-License-Identifier: GPL-3.0-or-later
#include "Update/vtkIsopointExecution.h"

#include "Common/vtkIsopointCompatibility.h"
#include "Common/vtkIsopointSMPTools.h"
#include "Core/Base/Threads.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace
{

/// Whether the backend is sequential by default rather than by choice.
bool isSequentialByDefault()
{
  const char* const backend = vtkSMPTools::GetBackend();
  return backend && std::strcmp(backend, "Sequential") == 0 &&
         !std::getenv("VTK_SMP_BACKEND_IN_USE");
}

std::size_t allowedThreads(std::size_t processes)
{
  std::size_t threads = isopoint::availableThreads(processes);
  const char* const limit = std::getenv("VTK_SMP_MAX_THREADS");
  for (const long most :
    { limit ? std::strtol(limit, nullptr, 10) : 0, static_cast<long>(vtkGetRequestedSMPThreads()) })
  {
    threads = most > 0 ? std::min(threads, static_cast<std::size_t>(most)) : threads;
  }
  return threads;
}

} // namespace

isopoint::Execution vtkMakeIsopointExecution(
  vtkAlgorithm* filter, bool useAllCores, std::size_t processes)
{
  isopoint::Execution execution = vtkMakeSMPExecution(filter);
  if (isopoint::hasThreads && useAllCores && isSequentialByDefault())
  {
    isopoint::useThreads(execution, allowedThreads(processes));
  }
  return execution;
}
