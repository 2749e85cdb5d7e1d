// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMapper.h"

#include "vtkIsopointSplatPolygons.h"

#include "vtkAlgorithmOutput.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkIsopointSplatMapper);

vtkIsopointSplatMapper::vtkIsopointSplatMapper() = default;
vtkIsopointSplatMapper::~vtkIsopointSplatMapper() = default;

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::SetInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Polygons->SetInputConnection(input);
  this->Superclass::SetInputConnection(port, input ? this->Polygons->GetOutputPort() : nullptr);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (const auto other = vtkIsopointSplatMapper::SafeDownCast(mapper))
  {
    this->Polygons->SetRadiusArrayName(other->Polygons->GetRadiusArrayName());
    this->Polygons->SetRadius(other->Polygons->GetRadius());
    this->Polygons->SetRadiusScale(other->Polygons->GetRadiusScale());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsopointSplatMapper::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Polygons->GetMTime());
}

//------------------------------------------------------------------------------
vtkIsopointSplatPolygons* vtkIsopointSplatMapper::GetPolygons()
{
  return this->Polygons;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Polygons:\n";
  this->Polygons->PrintSelf(os, indent.GetNextIndent());
}
