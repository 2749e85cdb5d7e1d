// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointExecution_h
#define vtkIsopointExecution_h

#include "Core/Base/Execution.h"

#include <cstddef>

class vtkAlgorithm;

/// Runs the core for a filter as vtkMakeSMPExecution() or, if vtkSMPTools is sequential merely by
/// default and useAllCores is set, on oneTBB if available (see
/// vtkScatteredContourFilter::SetUseAllCores()). The backend of vtkSMPTools is not changed: it is
/// global, and changing it is unsafe while other filters run.
/// @param processes number of processes that share the cores, including this one
isopoint::Execution vtkMakeIsopointExecution(
  vtkAlgorithm* filter, bool useAllCores, std::size_t processes = 1);

#endif
