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
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <memory>
#include <type_traits>

vtkScatteredContourFilter::vtkScatteredContourFilter()
  : Options(std::make_unique<vtkIsopointOptions>())
  , Contouring(std::make_unique<vtkIsopointContouring>(*this->Updater))
{
  this->Options->ContourValues = this->ContourValues;
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScatteredContourFilter::~vtkScatteredContourFilter() = default;

vtkIsopointOptionMacro(vtkScatteredContourFilter, Projection, int, isopoint::option::projection);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, NormalMethod, int, isopoint::option::normalMethod);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, DropGaps, vtkTypeBool, isopoint::option::dropGaps);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, ComputeNormals, vtkTypeBool, isopoint::option::computeNormals);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, ComputeGradients, vtkTypeBool, isopoint::option::computeGradients);
vtkIsopointOptionMacro(vtkScatteredContourFilter, ComputeProjectionOrders, vtkTypeBool,
  isopoint::option::computeProjectionOrders);
vtkIsopointOptionMacro(
  vtkScatteredContourFilter, OutputPointsPrecision, int, isopoint::option::outputPointsPrecision);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ComputeScalars, this->Options->ComputeScalars);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ContourBlocks, this->Options->ContourBlocks);

vtkMTimeType vtkScatteredContourFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

const isopoint::SampleCounts& vtkScatteredContourFilter::GetSampleCounts() const
{
  return this->Contouring->GetReport();
}

vtkIdType vtkScatteredContourFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->Contouring->GetReport().pointCount());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfUnprojectedPoints() const
{
  return static_cast<vtkIdType>(this->Contouring->GetReport().unprojectedPoints);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfDroppedInGaps() const
{
  return static_cast<vtkIdType>(this->Contouring->GetReport().droppedInGaps);
}

vtkPolyData* vtkScatteredContourFilter::GetOutput(int port)
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port));
}

vtkSmartPointer<vtkDataObject> vtkScatteredContourFilter::NewOutput(
  vtkInformationVector** inputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  return this->Options->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
           ? vtkNewIsopointComposite(input)
           : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
}

int vtkScatteredContourFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Contouring->Run(*this->Options, inputVector[0]->GetInformationObject(0),
    this->GetInputArrayInformation(0), outputVector->GetInformationObject(0));
  return 1;
}

namespace
{

const char* onOrOff(bool isOn)
{
  return isOn ? "On\n" : "Off\n";
}

} // namespace

void vtkScatteredContourFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  const isopoint::Options& core = this->Options->Core;
  isopoint::forEachOption(core,
    [&](const auto& option)
    {
      os << indent << option.name << ": ";
      if constexpr (std::is_same_v<std::decay_t<decltype(core.*option.value)>, bool>)
      {
        os << onOrOff(core.*option.value);
      }
      else
      {
        os << core.*option.value << "\n";
      }
    });
  os << indent << "ComputeScalars: " << onOrOff(this->Options->ComputeScalars);
  os << indent << "ContourBlocks: " << onOrOff(this->Options->ContourBlocks);
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
  os << indent << "NumberOfUnprojectedPoints: " << this->GetNumberOfUnprojectedPoints() << "\n";
  os << indent << "NumberOfDroppedInGaps: " << this->GetNumberOfDroppedInGaps() << "\n";
}
