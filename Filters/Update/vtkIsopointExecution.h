// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointExecution_h
#define vtkIsopointExecution_h

#include "Isopoint/Base/Execution.h"

#include <cstddef>

class vtkAlgorithm;

/**
 * How the core runs on behalf of a filter: on the threads of vtkSMPTools, reporting progress as the
 * filter's and stopping if the filter is aborted. If useAllCores is set and vtkSMPTools is
 * sequential merely by default, it runs on threads of its own instead (see
 * vtkScatteredIsopointFilter::SetUseAllCores()). The backend of vtkSMPTools is not changed, since
 * that is global and unsafe while other filters run.
 * @param ranksOnHost the number of processes that do the same on this host, among which its cores
 * are shared
 */
isopoint::Execution vtkMakeIsopointExecution(
  vtkAlgorithm* filter, bool useAllCores, std::size_t ranksOnHost = 1);

/**
 * An isopoint::ParallelFor on at most this many threads (1 or more), the calling one included; the
 * others are started for the call. If the system or memory grants fewer, these do all the work. An
 * exception of the task in the calling thread is passed on after the other threads have ended; in
 * other threads the task must not throw, which isopoint::forRanges() ensures.
 */
void vtkForIsopointRanges(
  std::size_t threads, std::size_t count, std::size_t grain, const isopoint::RangeTask& task);

#endif
