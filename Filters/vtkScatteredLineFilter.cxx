// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredLineFilter.h"

#include "Common/vtkIsopointArrays.h"
#include "Output/vtkIsopointOutput.h"

#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>

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

void vtkScatteredLineFilter::MakePlaces(vtkInformationVector**, vtkInformation* outputInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  auto* const line = vtkPolyData::SafeDownCast(vtkDataObject::GetData(outputInfo));
  const bool isFirst = outputInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()) <= 0;
  const vtkIdType count = isFirst ? vtkIdType{ this->Resolution } + 1 : 0;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkAllocateTuples(points->GetData(), count);
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("arc_length");
  vtkAllocateTuples(lengths, count);
  const double length = std::sqrt(vtkMath::Distance2BetweenPoints(this->Point1, this->Point2));
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double share = static_cast<double>(i) / this->Resolution;
    double place[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = (1.0 - share) * this->Point1[axis] + share * this->Point2[axis];
    }
    points->SetPoint(i, place);
    lengths->SetValue(i, share * length);
  }
  line->SetPoints(points);
  if (isFirst)
  {
    line->SetLines(vtkNewIsopointPolyline(count));
  }
  line->GetPointData()->AddArray(lengths);
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
