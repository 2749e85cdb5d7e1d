// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredContourFilter.h"

#include "Output/vtkIsopointOutput.h"
#include "Update/vtkIsopointContouring.h"
#include "Update/vtkIsopointOptions.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <memory>

vtkScatteredContourFilter::vtkScatteredContourFilter()
  : Contouring(std::make_unique<vtkIsopointContouring>(*this->Updater))
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScatteredContourFilter::~vtkScatteredContourFilter() = default;

vtkIsopointOptionMacro(vtkScatteredContourFilter, Projection, int, isopoint::option::projection);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, NormalMethod, int, isopoint::option::normalMethod);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, ComputeNormals, vtkTypeBool, isopoint::option::computeNormals);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, ComputeGradients, vtkTypeBool, isopoint::option::computeGradients);
vtkIsopointOptionMacro(vtkScatteredContourFilter, ComputeProjectionOrders, vtkTypeBool,
  isopoint::option::computeProjectionOrders);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ComputeScalars, this->Options->ComputeScalars);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ContourBlocks, this->Options->ContourBlocks);

const isopoint::Report& vtkScatteredContourFilter::GetReport() const
{
  return this->Contouring->GetReport();
}

vtkIdType vtkScatteredContourFilter::GetNumberOfUnprojectedPoints() const
{
  return static_cast<vtkIdType>(this->Contouring->GetReport().unprojectedPoints);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfDroppedInGaps() const
{
  return static_cast<vtkIdType>(this->Contouring->GetReport().droppedCount());
}

vtkSmartPointer<vtkDataObject> vtkScatteredContourFilter::NewOutput(
  vtkInformationVector** inputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  return this->Options->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
           ? vtkNewIsopointComposite(input)
           : this->Superclass::NewOutput(inputVector);
}

int vtkScatteredContourFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Contouring->Run(*this->Options, inputVector[0]->GetInformationObject(0),
    this->GetInputArrayInformation(0), outputVector->GetInformationObject(0));
  return 1;
}

void vtkScatteredContourFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ComputeScalars: " << (this->Options->ComputeScalars ? "On\n" : "Off\n");
  os << indent << "ContourBlocks: " << (this->Options->ContourBlocks ? "On\n" : "Off\n");
  os << indent << "NumberOfUnprojectedPoints: " << this->GetNumberOfUnprojectedPoints() << "\n";
  os << indent << "NumberOfDroppedInGaps: " << this->GetNumberOfDroppedInGaps() << "\n";
}
