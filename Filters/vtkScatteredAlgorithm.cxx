// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredAlgorithm.h"

#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstring>

vtkScatteredAlgorithm::vtkScatteredAlgorithm(int samplesPort)
  : SamplesPort(samplesPort)
  , Updater(std::make_unique<vtkIsopointUpdate>(this, samplesPort))
{
  this->SetNumberOfInputPorts(samplesPort + 1);
  this->SetNumberOfOutputPorts(1);
}

vtkScatteredAlgorithm::~vtkScatteredAlgorithm() = default;

vtkIsopointSwitchMacro(vtkScatteredAlgorithm, KeepTree, this->Updater->Settings.KeepTree);
vtkIsopointSwitchMacro(vtkScatteredAlgorithm, UseAllCores, this->Updater->Settings.UseAllCores);
vtkIsopointSwitchMacro(vtkScatteredAlgorithm, UsePanelNames, this->Updater->Settings.UsePanelNames);

vtkDataObject* vtkScatteredAlgorithm::GetInput(int port)
{
  return this->GetNumberOfInputConnections(port) > 0 ? this->GetInputDataObject(port, 0) : nullptr;
}

void vtkScatteredAlgorithm::SetController(vtkMultiProcessController* controller)
{
  if (this->GetController() != controller)
  {
    this->Updater->SetController(controller);
    this->Modified();
  }
}

void vtkScatteredAlgorithm::SetUseGlobalController(bool use)
{
  this->SetController(use ? vtkMultiProcessController::GetGlobalController() : nullptr);
}

vtkMultiProcessController* vtkScatteredAlgorithm::GetController() const
{
  return this->Updater->GetController();
}

vtkIdType vtkScatteredAlgorithm::GetNumberOfSamples() const
{
  return static_cast<vtkIdType>(this->GetSampleCounts().samples);
}

vtkIdType vtkScatteredAlgorithm::GetNumberOfSkippedSamples() const
{
  return static_cast<vtkIdType>(this->GetSampleCounts().skippedCount());
}

int vtkScatteredAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkHyperTreeGrid");
  return 1;
}

int vtkScatteredAlgorithm::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

vtkSmartPointer<vtkDataObject> vtkScatteredAlgorithm::NewOutput(vtkInformationVector** inputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  return vtkSmartPointer<vtkDataObject>::Take(input ? input->NewInstance() : nullptr);
}

vtkTypeBool vtkScatteredAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    const vtkSmartPointer<vtkDataObject> required = this->NewOutput(inputVector);
    vtkDataObject* const output = vtkDataObject::GetData(outputVector);
    if (required && (!output || std::strcmp(output->GetClassName(), required->GetClassName()) != 0))
    {
      outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), required);
    }
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    return this->RequestInformation(request, inputVector, outputVector);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(request, inputVector, outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    const int result = this->RequestData(request, inputVector, outputVector);
    this->ErrorCode = this->Updater->GetErrorCode();
    return result;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

int vtkScatteredAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

int vtkScatteredAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformationVector* const samples = inputVector[this->SamplesPort];
  for (int i = 0; i < samples->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* const info = samples->GetInformationObject(i);
    info->Set(Pipeline::EXACT_EXTENT(), 1);
    if (!this->Updater->IsOnRanks())
    {
      // Neighbors of a piece's samples may be in any other piece.
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    }
    if (info->Has(Pipeline::WHOLE_EXTENT()))
    {
      // Not the extent of a structured output. The executive takes this piece of it.
      info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
    // Ghost samples would be skipped, so ghost levels of the output need none of the input.
    info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return 1;
}

void vtkScatteredAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, vtkTypeBool isOn)
  { os << indent << name << ": " << (isOn ? "On\n" : "Off\n"); };
  print("KeepTree", this->GetKeepTree());
  print("UseAllCores", this->GetUseAllCores());
  print("UsePanelNames", this->GetUsePanelNames());
  os << indent << "NumberOfSamples: " << this->GetNumberOfSamples() << "\n";
  os << indent << "NumberOfSkippedSamples: " << this->GetNumberOfSkippedSamples() << "\n";
}
