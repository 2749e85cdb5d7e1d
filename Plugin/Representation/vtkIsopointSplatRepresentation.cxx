// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatRepresentation.h"

#include "vtkIsopointPolygonMapper.h"
#include "vtkIsopointSplatPolygons.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkIsopointSplatRepresentation);

//------------------------------------------------------------------------------
vtkIsopointSplatRepresentation::vtkIsopointSplatRepresentation()
  : Polygons(vtkIsopointSplatPolygons::New())
{
  // The superclass deletes what it holds, and connects it in SetupDefaults().
  this->GeometryFilter->Delete();
  this->GeometryFilter = this->Polygons;
  this->GeometryFilter->AddObserver(vtkCommand::ProgressEvent, this,
    &vtkIsopointSplatRepresentation::HandleGeometryRepresentationProgress);
  this->Mapper->Delete();
  this->Mapper = vtkIsopointPolygonMapper::New();
  this->SetupDefaults();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetRadiusArrayName(const char* name)
{
  this->Polygons->SetRadiusArrayName(name);
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetRadius(double radius)
{
  this->Polygons->SetRadius(radius);
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::SetRadiusScale(double scale)
{
  this->Polygons->SetRadiusScale(scale);
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkIsopointSplatRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Polygons:\n";
  this->Polygons->PrintSelf(os, indent.GetNextIndent());
}
