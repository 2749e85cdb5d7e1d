// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatRepresentation.h"

#include "vtkIsopointPolygonMapper.h"
#include "vtkIsopointSplatPolygons.h"

#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkIsopointSplatRepresentation);

namespace
{

bool lacksNormals(vtkDataObject* data)
{
  std::vector<vtkDataSet*> leaves = vtkCompositeDataSet::GetDataSets(data);
  return std::any_of(leaves.begin(), leaves.end(),
    [](vtkDataSet* leaf)
    { return leaf->GetNumberOfPoints() > 0 && !leaf->GetPointData()->GetNormals(); });
}

} // namespace

vtkIsopointSplatRepresentation::vtkIsopointSplatRepresentation()
  : Polygons(vtkIsopointSplatPolygons::New())
{
  // The superclass deletes this filter, and connects it in SetupDefaults().
  this->GeometryFilter->Delete();
  this->GeometryFilter = this->Polygons;
  this->GeometryFilter->AddObserver(vtkCommand::ProgressEvent, this,
    &vtkIsopointSplatRepresentation::HandleGeometryRepresentationProgress);
  this->Mapper->Delete();
  this->Mapper = vtkIsopointPolygonMapper::New();
  this->SetupDefaults();
}

void vtkIsopointSplatRepresentation::SetRadiusArrayName(const char* name)
{
  this->Polygons->SetRadiusArrayName(name);
  this->MarkModified();
}

void vtkIsopointSplatRepresentation::SetRadius(double radius)
{
  this->Polygons->SetRadius(radius);
  this->MarkModified();
}

void vtkIsopointSplatRepresentation::SetRadiusScale(double scale)
{
  this->Polygons->SetRadiusScale(scale);
  this->MarkModified();
}

int vtkIsopointSplatRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->Polygons->GetRadius() == 0.0 && lacksNormals(vtkDataObject::GetData(inputVector[0])))
  {
    vtkWarningMacro("Isopoint Splats shows nothing of points without normals. Choose another"
                    " representation.");
    vtkNew<vtkInformationVector> nothing;
    vtkInformationVector* inputs[] = { nothing };
    return this->Superclass::RequestData(request, inputs, outputVector);
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

void vtkIsopointSplatRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Polygons:\n";
  this->Polygons->PrintSelf(os, indent.GetNextIndent());
}
