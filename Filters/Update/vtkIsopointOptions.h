// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOptions_h
#define vtkIsopointOptions_h

#include "Isopoint/ExtractionRequest.h"
#include "Output/vtkIsopointComputedArrays.h"

namespace isopoint
{
class Team;
}
class vtkScatteredIsopointFilter;

/**
 * Checks the options of a filter that its setters accept unchecked.
 * @throws vtkIsopointUsageError
 */
void vtkCheckIsopointOptions(vtkScatteredIsopointFilter* filter);

/**
 * Checks that the filters of all ranks have the same options. Collective.
 * @throws vtkIsopointUsageError on one rank and isopoint::FailedElsewhere on the others
 */
void vtkCheckIsopointOptionsOnRanks(isopoint::Team& team, vtkScatteredIsopointFilter* filter);

/**
 * The arrays that a filter is to compute.
 */
vtkIsopointComputedArrays::Choice vtkChooseIsopointArrays(vtkScatteredIsopointFilter* filter);

/**
 * The request to the core that the options of a filter amount to, without an isovalue.
 */
isopoint::ExtractionRequest vtkMakeIsopointRequest(vtkScatteredIsopointFilter* filter);

#endif
