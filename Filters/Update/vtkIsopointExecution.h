// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointExecution_h
#define vtkIsopointExecution_h

#include "Core/Base/Execution.h"

#include <cstddef>

class vtkAlgorithm;

/**
 * How the core runs on behalf of a filter: on the threads of vtkSMPTools, reporting progress as the
 * filter's and stopping if the filter is aborted. If useAllCores is set and vtkSMPTools is
 * sequential merely by default, it runs on those of oneTBB instead, where that is available (see
 * vtkScatteredIsopointFilter::SetUseAllCores()). The backend of vtkSMPTools is not changed, since
 * that is global and unsafe while other filters run.
 * @param processes how many do the same on the same cores, which are shared among them
 */
isopoint::Execution vtkMakeIsopointExecution(
  vtkAlgorithm* filter, bool useAllCores, std::size_t processes = 1);

#endif
