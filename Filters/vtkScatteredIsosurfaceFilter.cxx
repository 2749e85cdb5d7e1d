// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsosurfaceFilter.h"

#include "Update/vtkIsopointOptions.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkScatteredIsosurfaceFilter);

vtkScatteredIsosurfaceFilter::vtkScatteredIsosurfaceFilter()
{
  this->SetProgressText("Scattered Isosurface"); // as in ParaView's menu
  this->Options->Core.triangles = true;
}

vtkIsopointOptionMacro(
  vtkScatteredIsosurfaceFilter, Regularize, vtkTypeBool, isopoint::option::regularize);
vtkIsopointOptionMacro(
  vtkScatteredIsosurfaceFilter, Capping, vtkTypeBool, isopoint::option::capping);
vtkIsopointOptionMacro(
  vtkScatteredIsosurfaceFilter, MinimumPieceSize, double, isopoint::option::minimumPieceSize);
