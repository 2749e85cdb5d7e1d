// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredContourFilter.h"

#include "Output/vtkIsopointOutput.h"
#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>

vtkScatteredContourFilter::vtkScatteredContourFilter()
  : Options(std::make_unique<vtkIsopointOptions>())
  , Updater(std::make_unique<vtkIsopointUpdate>(this))
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
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ComputeScalars);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, ContourBlocks);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, KeepTree);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, UseAllCores);
vtkIsopointSwitchMacro(vtkScatteredContourFilter, UsePanelNames);

void vtkScatteredContourFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->GetController() != controller)
  {
    this->Updater->SetController(controller);
    this->Modified();
  }
}

void vtkScatteredContourFilter::SetUseGlobalController(bool use)
{
  this->SetController(use ? vtkMultiProcessController::GetGlobalController() : nullptr);
}

vtkMultiProcessController* vtkScatteredContourFilter::GetController() const
{
  return this->Updater->GetController();
}

vtkMTimeType vtkScatteredContourFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfSamples() const
{
  return static_cast<vtkIdType>(this->Updater->GetReport().samples);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->Updater->GetReport().pointCount());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfSkippedSamples() const
{
  return static_cast<vtkIdType>(this->Updater->GetReport().skippedCount());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfUnprojectedPoints() const
{
  return static_cast<vtkIdType>(this->Updater->GetReport().unprojectedPoints);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfDroppedInGaps() const
{
  return static_cast<vtkIdType>(this->Updater->GetReport().droppedInGaps);
}

int vtkScatteredContourFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
  return 1;
}

int vtkScatteredContourFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  // A vtkPolyData, or a composite of these (see SetContourBlocks()).
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

vtkTypeBool vtkScatteredContourFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const output = vtkDataObject::GetData(outputVector);
  const vtkSmartPointer<vtkDataObject> required =
    this->Options->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
      ? vtkNewIsopointComposite(input)
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
  if (!output || std::strcmp(output->GetClassName(), required->GetClassName()) != 0)
  {
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), required);
  }
  return 1;
}

int vtkScatteredContourFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  vtkInformation* const info = inputVector[0]->GetInformationObject(0);
  if (!this->Updater->IsOnRanks())
  {
    // Neighbors of a piece's samples may be in any other piece.
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  }
  // Ghost samples would be skipped, so ghost levels of the output need none of the input.
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return result;
}

int vtkScatteredContourFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Returning 0 would add an error of the executive to that of this filter.
  this->ErrorCode = this->Updater->Run(
    *this->Options, inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
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
  os << indent << "KeepTree: " << onOrOff(this->Options->KeepTree);
  os << indent << "UseAllCores: " << onOrOff(this->Options->UseAllCores);
  os << indent << "UsePanelNames: " << onOrOff(this->Options->UsePanelNames);
  os << indent << "NumberOfSamples: " << this->GetNumberOfSamples() << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->GetNumberOfSkippedSamples() << "\n";
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
  os << indent << "NumberOfUnprojectedPoints: " << this->GetNumberOfUnprojectedPoints() << "\n";
  os << indent << "NumberOfDroppedInGaps: " << this->GetNumberOfDroppedInGaps() << "\n";
}
