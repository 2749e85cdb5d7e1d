// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMapper.h"

#include "vtkAlgorithmOutput.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkIsopointSplatMapper);

void vtkIsopointSplatMapper::SetInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Polygons->SetInputConnection(input);
  this->Superclass::SetInputConnection(port, input ? this->Polygons->GetOutputPort() : nullptr);
}

void vtkIsopointSplatMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (mapper == this)
  {
    return;
  }
  this->Superclass::ShallowCopy(mapper);
  if (const auto other = vtkIsopointSplatMapper::SafeDownCast(mapper))
  {
    this->SetRadiusArrayName(other->GetRadiusArrayName());
    this->SetRadius(other->GetRadius());
    this->SetRadiusScale(other->GetRadiusScale());
    // The superclass copies the other mapper's polygons as input; they must not become splats
    // again.
    vtkIsopointSplatPolygons* const polygons = other->GetPolygons();
    this->SetInputConnection(0,
      polygons->GetNumberOfInputConnections(0) > 0 ? polygons->GetInputConnection(0, 0) : nullptr);
  }
}

vtkMTimeType vtkIsopointSplatMapper::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Polygons->GetMTime());
}

void vtkIsopointSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Polygons:\n";
  this->Polygons->PrintSelf(os, indent.GetNextIndent());
}
