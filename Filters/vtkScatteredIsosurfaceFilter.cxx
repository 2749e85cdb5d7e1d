// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkScatteredIsosurfaceFilter);

vtkScatteredIsosurfaceFilter::vtkScatteredIsosurfaceFilter()
{
  this->DropGaps = 1;
  this->SetProgressText("Scattered Isosurface");
}

void vtkScatteredIsosurfaceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfDroppedTetrahedra: " << this->NumberOfDroppedTetrahedra << "\n";
}
