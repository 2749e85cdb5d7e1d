// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsopointFilter.h"

#include "Update/vtkIsopointOptions.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkScatteredIsopointFilter);

vtkScatteredIsopointFilter::vtkScatteredIsopointFilter()
{
  this->SetProgressText("Scattered Isopoints"); // as in ParaView's menu
}

void vtkScatteredIsopointFilter::FillOptions(vtkIsopointOptions& options)
{
  this->Superclass::FillOptions(options);
  options.Angle = this->Angle;
  options.MinimumSpacing = this->MinimumSpacing;
  options.NumberOfNeighbors = this->NumberOfNeighbors;
  options.ComputeSplats = this->ComputeSplats != 0;
}
