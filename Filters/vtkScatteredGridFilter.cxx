// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredGridFilter.h"

#include "Input/vtkIsopointBlocks.h"
#include "Output/vtkIsopointPlaces.h"
#include "Update/vtkIsopointProbing.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <sstream>

vtkStandardNewMacro(vtkScatteredGridFilter);

namespace
{

/// Cuts an extent that was asked for to that of the whole image. Where it ends as the announced
/// image, it ends as the whole one.
void cut(const int whole[6], const int announced[6], int extent[6])
{
  for (int axis = 0; axis < 6; axis += 2)
  {
    const bool isToEnd = extent[axis + 1] == announced[axis + 1];
    extent[axis + 1] = isToEnd ? whole[axis + 1] : std::min(extent[axis + 1], whole[axis + 1]);
  }
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5])
  {
    // The extent of no points, for any axis.
    constexpr int none[] = { 0, -1, 0, -1, 0, -1 };
    std::copy_n(none, 6, extent);
  }
}

} // namespace

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

void vtkScatteredGridFilter::AddArray(const char* name)
{
  if (name && this->Arrays.insert(name).second)
  {
    this->Modified();
  }
}

void vtkScatteredGridFilter::ClearArrays()
{
  if (!this->Arrays.empty())
  {
    this->Arrays.clear();
    this->Modified();
  }
}

const std::set<std::string>* vtkScatteredGridFilter::GetChosenArrays() const
{
  return this->Arrays.empty() ? nullptr : &this->Arrays;
}

int vtkScatteredGridFilter::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Superclass::RequestInformation(request, inputVector, outputVector);
  vtkInformation* const info = outputVector->GetInformationObject(0);
  int extent[6];
  this->GuessExtent(inputVector[0]->GetInformationObject(0), extent);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  // Those of samples that are an image.
  info->Remove(vtkDataObject::ORIGIN());
  info->Remove(vtkDataObject::SPACING());
  info->Remove(vtkDataObject::DIRECTION());
  return 1;
}

/// The extent is known when the samples are. Until then it is that of the last update if nothing
/// changed, or follows from bounds of the present data. MakePlaces() corrects it.
void vtkScatteredGridFilter::GuessExtent(vtkInformation* inputInfo, int extent[6])
{
  vtkDataObject* const input = vtkDataObject::GetData(inputInfo);
  if (input && input->GetMTime() == this->LastInputTime && this->DescribeGrid() == this->LastGrid)
  {
    std::copy_n(this->LastExtent, 6, extent);
    return;
  }
  vtkBoundingBox box(this->SamplingBounds);
  if (this->UseInputBounds)
  {
    box.Reset();
    for (vtkDataObject* const leaf : vtkListIsopointLeaves(input))
    {
      auto* const data = vtkDataSet::SafeDownCast(leaf);
      if (data && data->GetNumberOfPoints() > 0)
      {
        box.AddBounds(data->GetBounds());
      }
    }
  }
  double bounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  this->IsGuessOfData = box.IsValid() != 0;
  if (this->IsGuessOfData)
  {
    box.GetBounds(bounds);
  }
  try
  {
    const vtkIsopointGrid grid =
      vtkFindIsopointGrid(bounds, this->SamplingDimensions, this->Spacing);
    std::copy_n(grid.Extent, 6, extent);
  }
  catch (const std::exception&)
  {
    std::fill_n(extent, 6, 0); // the update reports the error
  }
}

std::string vtkScatteredGridFilter::DescribeGrid() const
{
  std::ostringstream text;
  text << std::hexfloat;
  for (int axis = 0; axis < 3; ++axis)
  {
    text << " " << this->SamplingDimensions[axis] << " " << this->Spacing[axis];
  }
  for (const double bound : this->SamplingBounds)
  {
    text << " " << (this->UseInputBounds ? 0.0 : bound);
  }
  return text.str();
}

std::string vtkScatteredGridFilter::DescribeOptions() const
{
  std::string text = this->Superclass::DescribeOptions() + this->DescribeGrid();
  for (const std::string& name : this->Arrays)
  {
    text += " " + name;
  }
  return text;
}

void vtkScatteredGridFilter::MakePlaces(
  vtkInformationVector** inputVector, vtkInformation* outputInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  double bounds[6];
  std::copy_n(this->SamplingBounds, 6, bounds);
  if (this->UseInputBounds)
  {
    this->Probing->FindBounds(bounds);
  }
  int announced[6];
  outputInfo->Get(Pipeline::WHOLE_EXTENT(), announced);
  vtkIsopointGrid grid = vtkFindIsopointGrid(bounds, this->SamplingDimensions, this->Spacing);
  if (this->IsGuessOfData && this->Updater->GetProcesses().size() == 1)
  {
    // Filters downstream do not hear of another extent, as of samples that move or are hidden.
    for (int axis = 0; axis < 3; ++axis)
    {
      const int steps = announced[2 * axis + 1];
      int& needed = grid.Extent[2 * axis + 1];
      if (this->SamplingDimensions[axis] > 0 || steps <= 0 || needed <= 0)
      {
        continue;
      }
      if (this->Spacing[axis] == 0.0)
      {
        grid.Spacing[axis] = (bounds[2 * axis + 1] - bounds[2 * axis]) / steps;
        needed = steps;
      }
      else
      {
        needed = std::max(needed, steps);
      }
    }
  }
  std::copy_n(grid.Extent, 6, this->LastExtent);
  this->LastGrid = this->DescribeGrid();
  this->LastInputTime = vtkDataObject::GetData(inputVector[0])->GetMTime();

  int extent[6];
  outputInfo->Get(Pipeline::UPDATE_EXTENT(), extent);
  if (!std::equal(announced, announced + 6, grid.Extent))
  {
    const int pieces = outputInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    if (pieces > 1)
    {
      vtkNew<vtkExtentTranslator> translator;
      translator->PieceToExtentThreadSafe(outputInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
        outputInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), this->LastExtent, extent,
        vtkExtentTranslator::BLOCK_MODE, 0);
    }
    else
    {
      cut(grid.Extent, announced, extent);
    }
    outputInfo->Set(Pipeline::WHOLE_EXTENT(), grid.Extent, 6);
    outputInfo->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
  vtkMakeIsopointGrid(grid, extent, vtkImageData::SafeDownCast(vtkDataObject::GetData(outputInfo)));
}

void vtkScatteredGridFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplingDimensions: " << this->SamplingDimensions[0] << " "
     << this->SamplingDimensions[1] << " " << this->SamplingDimensions[2] << "\n";
  os << indent << "Spacing: " << this->Spacing[0] << " " << this->Spacing[1] << " "
     << this->Spacing[2] << "\n";
  os << indent << "Arrays:";
  for (const std::string& name : this->Arrays)
  {
    os << " " << name;
  }
  os << "\n";
  os << indent << "UseInputBounds: " << this->UseInputBounds << "\n";
  os << indent << "SamplingBounds:";
  for (const double bound : this->SamplingBounds)
  {
    os << " " << bound;
  }
  os << "\n";
}
