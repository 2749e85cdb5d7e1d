// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredProbeFilter.h"

#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointGhosts.h"
#include "Output/vtkIsopointPlaces.h"
#include "Update/vtkIsopointNames.h"
#include "Update/vtkIsopointProbing.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>

vtkStandardNewMacro(vtkScatteredProbeFilter);

vtkScatteredProbeFilter::vtkScatteredProbeFilter(int samplesPort)
  : vtkScatteredAlgorithm(samplesPort)
  , Probing(std::make_unique<vtkIsopointProbing>(*this->Updater))
{
  this->SetProgressText("Scattered Probe"); // as in ParaView's menu
}

vtkScatteredProbeFilter::~vtkScatteredProbeFilter() = default;

void vtkScatteredProbeFilter::SetSourceData(vtkDataObject* source)
{
  this->SetInputData(this->SamplesPort, source);
}

vtkDataObject* vtkScatteredProbeFilter::GetSource()
{
  return this->GetInput(this->SamplesPort);
}

void vtkScatteredProbeFilter::SetSourceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(this->SamplesPort, output);
}

void vtkScatteredProbeFilter::AddNearestArray(const char* name)
{
  if (vtkAddIsopointName(this->NearestArrays, name))
  {
    this->Modified();
  }
}

void vtkScatteredProbeFilter::ClearNearestArrays()
{
  if (vtkClearIsopointNames(this->NearestArrays))
  {
    this->Modified();
  }
}

int vtkScatteredProbeFilter::GetNumberOfNearestArrays()
{
  return static_cast<int>(this->NearestArrays.size());
}

const char* vtkScatteredProbeFilter::GetNearestArray(int i)
{
  return vtkGetIsopointName(this->NearestArrays, i);
}

const isopoint::SampleCounts& vtkScatteredProbeFilter::GetSampleCounts() const
{
  return this->Probing->GetCounts();
}

int vtkScatteredProbeFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  this->Superclass::FillInputPortInformation(port, info);
  if (port != this->SamplesPort)
  {
    info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE()); // Set() replaces the first type alone
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  return 1;
}

int vtkScatteredProbeFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const source = inputVector[this->SamplesPort]->GetInformationObject(0);
  if (source->Has(Pipeline::TIME_STEPS()))
  {
    outputVector->GetInformationObject(0)->CopyEntry(source, Pipeline::TIME_STEPS());
    outputVector->GetInformationObject(0)->CopyEntry(source, Pipeline::TIME_RANGE());
  }
  return 1;
}

std::string vtkScatteredProbeFilter::DescribeOptions() const
{
  std::ostringstream text;
  text << std::hexfloat << this->Interpolation << " " << this->NullPointsStrategy << " "
       << this->NullValue << " " << this->ValidPointsMaskArrayName;
  for (const std::string& name : this->NearestArrays)
  {
    text << " \"" << name << "\"";
  }
  return text.str();
}

std::set<std::string> vtkScatteredProbeFilter::ListOwnArrays() const
{
  return this->NullPointsStrategy == MASK_POINTS
           ? std::set<std::string>{ this->ValidPointsMaskArrayName }
           : std::set<std::string>{};
}

const std::set<std::string>* vtkScatteredProbeFilter::GetChosenArrays() const
{
  return nullptr;
}

int vtkScatteredProbeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* const outputInfo = outputVector->GetInformationObject(0);
  vtkDataObject* const output = vtkDataObject::GetData(outputInfo);
  this->Probing->Run(output,
    [&]()
    {
      this->Probing->Load(inputVector[this->SamplesPort]->GetInformationObject(0),
        vtkIsopointArrayChoice(), this->DescribeOptions());
      this->MakePlaces(inputVector, outputInfo);
      this->FillOutput(output);
    });
  return 1;
}

void vtkScatteredProbeFilter::MakePlaces(
  vtkInformationVector** inputVector, vtkInformation* outputInfo)
{
  vtkCopyIsopointPlaces(vtkDataObject::GetData(inputVector[0]),
    { this->PassPointArrays != 0, this->PassCellArrays != 0, this->PassFieldArrays != 0 },
    vtkDataObject::GetData(outputInfo));
}

void vtkScatteredProbeFilter::FillOutput(vtkDataObject* output)
{
  std::vector<vtkDataSet*> parts;
  std::vector<isopoint::Vector> places;
  for (vtkDataObject* const leaf : vtkListIsopointLeaves(output))
  {
    if (auto* const part = vtkDataSet::SafeDownCast(leaf))
    {
      parts.push_back(part);
      vtkAppendIsopointPlaces(part, places);
    }
  }
  isopoint::ProbeOptions options;
  options.method = static_cast<isopoint::PlaceMethod>(this->Interpolation);
  static_assert(NEAREST == static_cast<int>(isopoint::PlaceMethod::Nearest));
  options.outside = this->NullPointsStrategy == CLOSEST_POINT ? isopoint::OutsideStrategy::Nearest
                                                              : isopoint::OutsideStrategy::Number;
  if (this->NullPointsStrategy == NULL_VALUE)
  {
    options.outsideNumber = this->NullValue;
  }
  std::vector<std::uint8_t> kinds;
  const std::vector<vtkIsopointProbing::Array> arrays =
    this->Probing->ProbeAll(places, options, this->GetChosenArrays(), this->NearestArrays,
      this->ListOwnArrays(), this->MarkBlankPointsAndCells != 0, kinds);

  std::vector<unsigned char> areNull(places.size());
  std::transform(kinds.begin(), kinds.end(), areNull.begin(),
    [](std::uint8_t kind) { return static_cast<unsigned char>(kind & isopoint::PlaceOutside); });
  vtkIdType first = 0;
  for (vtkDataSet* const part : parts)
  {
    const unsigned char* const areNullHere = areNull.data() + first;
    for (const auto& [values, attribute] : arrays)
    {
      vtkAddIsopointTuples(
        values, first, part->GetNumberOfPoints(), attribute, part->GetPointData());
    }
    if (this->NullPointsStrategy == MASK_POINTS)
    {
      vtkAddIsopointMask(areNullHere, this->ValidPointsMaskArrayName, part);
    }
    if (this->MarkBlankPointsAndCells)
    {
      vtkHideIsopointPoints(this->Updater->GetExecution(), areNullHere, part);
    }
    first += part->GetNumberOfPoints();
  }
}

void vtkScatteredProbeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interpolation: " << this->Interpolation << "\n";
  vtkPrintIsopointNames(os, indent, "NearestArrays", this->NearestArrays);
  os << indent << "NullPointsStrategy: " << this->NullPointsStrategy << "\n";
  os << indent << "NullValue: " << this->NullValue << "\n";
  os << indent << "ValidPointsMaskArrayName: " << this->ValidPointsMaskArrayName << "\n";
  os << indent << "MarkBlankPointsAndCells: " << this->MarkBlankPointsAndCells << "\n";
  os << indent << "PassPointArrays: " << this->PassPointArrays << "\n";
  os << indent << "PassCellArrays: " << this->PassCellArrays << "\n";
  os << indent << "PassFieldArrays: " << this->PassFieldArrays << "\n";
}
