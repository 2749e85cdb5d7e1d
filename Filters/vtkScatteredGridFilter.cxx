// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredGridFilter.h"

#include "Output/vtkIsopointPlaces.h"
#include "Update/vtkIsopointProbing.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>

vtkStandardNewMacro(vtkScatteredGridFilter);

vtkScatteredGridFilter::vtkScatteredGridFilter()
  : vtkScatteredProbeFilter(0)
{
  this->SetProgressText("Scattered Grid"); // as in ParaView's menu
  this->MarkBlankPointsAndCells = true;
  this->NullPointsStrategy = CLOSEST_POINT;
}

vtkImageData* vtkScatteredGridFilter::GetOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkSmartPointer<vtkDataObject> vtkScatteredGridFilter::NewOutput(vtkInformationVector**)
{
  return vtkSmartPointer<vtkImageData>::New();
}

int vtkScatteredGridFilter::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  this->Superclass::RequestInformation(request, inputVector, outputVector);
  vtkInformation* const info = outputVector->GetInformationObject(0);
  int extent[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = std::max(this->SamplingDimensions[axis], 1) - 1;
  }
  info->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  // Those of samples that are an image.
  info->Remove(vtkDataObject::ORIGIN());
  info->Remove(vtkDataObject::SPACING());
  info->Remove(vtkDataObject::DIRECTION());
  return 1;
}

std::string vtkScatteredGridFilter::DescribeOptions() const
{
  std::ostringstream text;
  text << this->Superclass::DescribeOptions() << std::hexfloat;
  for (const int count : this->SamplingDimensions)
  {
    text << " " << count;
  }
  for (const double bound : this->SamplingBounds)
  {
    text << " " << (this->UseInputBounds ? 0.0 : bound);
  }
  return text.str();
}

void vtkScatteredGridFilter::MakePlaces(vtkInformationVector**, vtkInformation* outputInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  double bounds[6];
  std::copy_n(this->SamplingBounds, 6, bounds);
  if (this->UseInputBounds)
  {
    this->Probing->FindBounds(bounds);
  }
  int whole[6];
  int extent[6];
  outputInfo->Get(Pipeline::WHOLE_EXTENT(), whole);
  outputInfo->Get(Pipeline::UPDATE_EXTENT(), extent);
  vtkMakeIsopointGrid(bounds, this->SamplingDimensions, whole, extent,
    vtkImageData::SafeDownCast(vtkDataObject::GetData(outputInfo)));
  // Filters downstream and the next update do not take missing layers for missing data. Pieces
  // remain those of the same extent, which the executive keeps for them.
  if (outputInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) <= 1)
  {
    outputInfo->Set(Pipeline::WHOLE_EXTENT(), whole, 6);
    outputInfo->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
}

void vtkScatteredGridFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  os << indent << "UseInputBounds: " << this->UseInputBounds << "\n";
  os << indent << "SamplingBounds:";
  for (const double bound : this->SamplingBounds)
  {
    os << " " << bound;
  }
  os << "\n";
}
