// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSMPTools_h
#define vtkIsopointSMPTools_h

#include "Common/vtkIsopointCompatibility.h"
#include "Core/Base/Execution.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <cstddef>

/// Runs the core for a filter: on the threads of vtkSMPTools, with the filter's progress and abort
/// flag.
inline isopoint::Execution vtkMakeSMPExecution(vtkAlgorithm* filter)
{
  isopoint::Execution execution;
  execution.threads =
    static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
  execution.parallelFor = [](std::size_t count, std::size_t grain, const isopoint::RangeTask& task)
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>(count), static_cast<vtkIdType>(grain),
      [&task](vtkIdType begin, vtkIdType end)
      { task(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
  };
  execution.progress = [filter](double share) { filter->UpdateProgress(share); };
  execution.isAborted = [filter]() { return vtkIsAborted(filter); };
  return execution;
}

#endif
