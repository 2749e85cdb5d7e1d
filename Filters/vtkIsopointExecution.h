// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointExecution_h
#define vtkIsopointExecution_h

#include "Isopoint/Base/Execution.h"

#include <cstddef>

class vtkAlgorithm;

/**
 * How the core runs on behalf of a filter: on vtkSMPTools' threads, and asking the filter whether
 * to abort. Where useAllCores is set and vtkSMPTools runs sequentially only because it was built
 * so, on threads of its own (see vtkScatteredIsopointFilter::SetUseAllCores); vtkSMPTools' global
 * state is left alone, since changing it is not safe while other filters run.
 */
isopoint::Execution vtkMakeIsopointExecution(vtkAlgorithm* filter, bool useAllCores);

/**
 * An isopoint::ParallelFor on at most so many threads (1 or more), started for the call; the
 * calling thread is one of them. Where the system or memory grants no more threads, those there are
 * do all the work. An exception that the task throws in the calling thread is passed on once the
 * other threads have ended; in another thread the task must not throw, and isopoint::forRanges()
 * sees to that.
 */
void vtkForIsopointRanges(
  std::size_t threads, std::size_t count, std::size_t grain, const isopoint::RangeTask& task);

/**
 * A view of an execution whose progress from 0 to 1 is the filter's from begin to end.
 */
isopoint::Execution vtkMakeIsopointStep(
  const isopoint::Execution& execution, vtkAlgorithm* filter, double begin, double end);

#endif
