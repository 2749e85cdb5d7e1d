// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredContourFilter.h"

#include "Output/vtkIsopointOutput.h"
#include "Update/vtkIsopointFindings.h"
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
  : LastUpdate(std::make_unique<vtkIsopointUpdate>(this))
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkScatteredContourFilter::~vtkScatteredContourFilter() = default;

void vtkScatteredContourFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->GetController() != controller)
  {
    this->LastUpdate->SetController(controller);
    this->Modified();
  }
}

void vtkScatteredContourFilter::SetUseGlobalController(bool use)
{
  this->SetController(use ? vtkMultiProcessController::GetGlobalController() : nullptr);
}

vtkMultiProcessController* vtkScatteredContourFilter::GetController() const
{
  return this->LastUpdate->GetController();
}

vtkMTimeType vtkScatteredContourFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfSamples() const
{
  return static_cast<vtkIdType>(this->LastUpdate->GetFindings().Samples);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->LastUpdate->GetFindings().GetNumberOfPoints());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfSkippedSamples() const
{
  return static_cast<vtkIdType>(this->LastUpdate->GetFindings().GetNumberOfSkippedSamples());
}

vtkIdType vtkScatteredContourFilter::GetNumberOfUnprojectedPoints() const
{
  return static_cast<vtkIdType>(this->LastUpdate->GetFindings().UnprojectedPoints);
}

vtkIdType vtkScatteredContourFilter::GetNumberOfDroppedInGaps() const
{
  return static_cast<vtkIdType>(this->LastUpdate->GetFindings().DroppedInGaps);
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
    this->ContourBlocks && vtkCompositeDataSet::SafeDownCast(input)
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
  if (!this->LastUpdate->HasOtherRanks())
  {
    // Neighbors of a piece's samples may be in any other piece.
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  }
  // Ghosts of the output are no reason to read the input with ghosts, which take no part.
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return result;
}

int vtkScatteredContourFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // To return 0 would add an error of the executive to that of this filter.
  this->ErrorCode =
    this->LastUpdate->Run([this](vtkIsopointOptions& options) { this->FillOptions(options); },
      inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
  return 1;
}

void vtkScatteredContourFilter::FillOptions(vtkIsopointOptions& options)
{
  const double* const isovalues = this->GetValues();
  options.Isovalues.assign(isovalues, isovalues + this->GetNumberOfContours());
  options.Array = vtkIsopointArrayChoice(this->GetInputArrayInformation(0));
  options.Projection = this->Projection;
  options.NormalMethod = this->NormalMethod;
  options.DropGaps = this->DropGaps != 0;
  options.ComputeNormals = this->ComputeNormals != 0;
  options.ComputeScalars = this->ComputeScalars != 0;
  options.ComputeGradients = this->ComputeGradients != 0;
  options.ComputeProjectionOrders = this->ComputeProjectionOrders != 0;
  options.OutputPointsPrecision = this->OutputPointsPrecision;
  options.ContourBlocks = this->ContourBlocks != 0;
  options.KeepTree = this->KeepTree != 0;
  options.UseAllCores = this->UseAllCores != 0;
}

void vtkScatteredContourFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  vtkIsopointOptions options;
  this->FillOptions(options);
  options.ForEach(
    [&](const char* name, auto value, double, double)
    {
      os << indent << name << ": ";
      if constexpr (std::is_same_v<decltype(value), bool>)
      {
        os << (value ? "On" : "Off") << "\n";
      }
      else
      {
        os << value << "\n";
      }
    });
  os << indent << "KeepTree: " << (this->KeepTree ? "On" : "Off") << "\n";
  os << indent << "UseAllCores: " << (this->UseAllCores ? "On" : "Off") << "\n";
  os << indent << "NumberOfSamples: " << this->GetNumberOfSamples() << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->GetNumberOfSkippedSamples() << "\n";
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
  os << indent << "NumberOfUnprojectedPoints: " << this->GetNumberOfUnprojectedPoints() << "\n";
  os << indent << "NumberOfDroppedInGaps: " << this->GetNumberOfDroppedInGaps() << "\n";
}
