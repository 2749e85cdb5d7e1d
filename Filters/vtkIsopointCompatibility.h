// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The one place that knows what differs between the VTK versions supported (9.1 and later).
 */
#ifndef vtkIsopointCompatibility_h
#define vtkIsopointCompatibility_h

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkVersionMacros.h"

/**
 * Whether a filter is to stop: itself, or (where VTK can tell) an algorithm downstream of it.
 */
inline bool vtkIsAborted(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}

/**
 * How many threads vtkSMPTools::Initialize() was called with, 0 if it was not.
 */
inline int vtkGetRequestedSMPThreads()
{
  return vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
}

#endif
