// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkScatteredIsosurfaceFilter);

vtkScatteredIsosurfaceFilter::vtkScatteredIsosurfaceFilter()
{
  this->SetProgressText("Scattered Isosurface");
}
