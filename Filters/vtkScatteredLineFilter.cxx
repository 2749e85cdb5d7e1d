// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredLineFilter.h"

#include "Output/vtkIsopointPlaces.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkScatteredLineFilter);

vtkScatteredLineFilter::vtkScatteredLineFilter()
  : vtkScatteredProbeFilter(0)
{
  this->SetProgressText("Scattered Line"); // as in ParaView's menu
}

vtkPolyData* vtkScatteredLineFilter::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkSmartPointer<vtkDataObject> vtkScatteredLineFilter::NewOutput(vtkInformationVector**)
{
  return vtkSmartPointer<vtkPolyData>::New();
}

int vtkScatteredLineFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

std::set<std::string> vtkScatteredLineFilter::ListOwnArrays() const
{
  std::set<std::string> names = this->Superclass::ListOwnArrays();
  names.insert(vtkIsopointLineLength);
  return names;
}

void vtkScatteredLineFilter::MakePlaces(vtkInformationVector**, vtkInformation* outputInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  auto* const line = vtkPolyData::SafeDownCast(vtkDataObject::GetData(outputInfo));
  const bool isFirst = outputInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()) <= 0;
  // All pieces have the same arrays.
  vtkMakeIsopointLine(
    this->Point1, this->Point2, isFirst ? vtkIdType{ this->Resolution } + 1 : 0, line);
}

void vtkScatteredLineFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point1: " << this->Point1[0] << " " << this->Point1[1] << " " << this->Point1[2]
     << "\n";
  os << indent << "Point2: " << this->Point2[0] << " " << this->Point2[1] << " " << this->Point2[2]
     << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
}
