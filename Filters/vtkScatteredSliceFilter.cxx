// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredSliceFilter.h"

#include "Update/vtkIsopointSlicing.h"

#include "vtkDataObject.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkStandardNewMacro(vtkScatteredSliceFilter);

vtkScatteredSliceFilter::vtkScatteredSliceFilter()
  : Slicing(std::make_unique<vtkIsopointSlicing>(*this->Updater))
{
  this->SetProgressText("Scattered Slice"); // as in ParaView's menu
}

vtkScatteredSliceFilter::~vtkScatteredSliceFilter() = default;

void vtkScatteredSliceFilter::SetCutFunction(vtkImplicitFunction* function)
{
  if (this->CutFunction != function)
  {
    this->CutFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkScatteredSliceFilter::GetCutFunction()
{
  return this->CutFunction;
}

vtkPolyData* vtkScatteredSliceFilter::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkMTimeType vtkScatteredSliceFilter::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->ContourValues->GetMTime(),
    this->CutFunction ? this->CutFunction->GetMTime() : 0 });
}

const isopoint::SampleCounts& vtkScatteredSliceFilter::GetSampleCounts() const
{
  return this->Slicing->GetReport();
}

vtkIdType vtkScatteredSliceFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->Slicing->GetReport().pointCount());
}

vtkSmartPointer<vtkDataObject> vtkScatteredSliceFilter::NewOutput(vtkInformationVector**)
{
  return vtkSmartPointer<vtkPolyData>::New();
}

int vtkScatteredSliceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkIsopointSlicing::Options options;
  options.Function = this->CutFunction;
  options.Offsets.assign(this->ContourValues->GetValues(),
    this->ContourValues->GetValues() + this->ContourValues->GetNumberOfContours());
  if (this->Interpolation != LINEAR)
  {
    options.Method =
      this->Interpolation == FITS ? isopoint::PlaceMethod::Blend : isopoint::PlaceMethod::Nearest;
  }
  options.Core.triangles = true;
  options.Core.projection = 0;
  options.Core.computeNormals = false;
  options.Core.computeSplats = false;
  options.Core.keepHullSlivers = true;
  options.Core.keepTetrahedra = this->GetKeepTree() != 0;
  options.Core.regularize = this->Regularize != 0;
  options.Core.dropGaps = this->DropGaps != 0;
  options.Core.outputPointsPrecision = this->OutputPointsPrecision;
  this->Slicing->Run(
    options, inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
  return 1;
}

void vtkScatteredSliceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CutFunction: " << this->CutFunction.Get() << "\n";
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Interpolation: " << this->Interpolation << "\n";
  os << indent << "Regularize: " << this->Regularize << "\n";
  os << indent << "DropGaps: " << this->DropGaps << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
}
