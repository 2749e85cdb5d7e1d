// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointPolygonMapper.h"

#include "Common/vtkIsopointArrays.h"

#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"

vtkStandardNewMacro(vtkIsopointPolygonMapper);

vtkIsopointPolygonMapper::vtkIsopointPolygonMapper()
{
  this->SetPointIdArrayName(vtkOriginalPointIdsArrayName);
  this->SetCellIdArrayName(vtkOriginalCellIdsArrayName);
}

void vtkIsopointPolygonMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  // For a selection of points, VTK draws vertices instead of triangles. All vertices of a splat
  // have the id of its point, so triangles can be drawn as for a selection of cells.
  vtkHardwareSelector* const selector = renderer->GetSelector();
  const bool selectsPoints =
    selector && selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  if (selectsPoints)
  {
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  }
  this->Superclass::Render(renderer, actor);
  if (selectsPoints)
  {
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  }
}
