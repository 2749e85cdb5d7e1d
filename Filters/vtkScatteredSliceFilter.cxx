// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredSliceFilter.h"

#include "Update/vtkIsopointNames.h"
#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointSlicing.h"

#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkScatteredSliceFilter);

vtkScatteredSliceFilter::vtkScatteredSliceFilter()
  : Slicing(std::make_unique<vtkIsopointSlicing>(*this->Updater))
{
  this->SetProgressText("Scattered Slice"); // as in ParaView's menu
  this->Options->Core = vtkIsopointSlicing::OptionsOfCore();
  this->Options->Core.keepHullSlivers = true;
}

vtkScatteredSliceFilter::~vtkScatteredSliceFilter() = default;

vtkIsopointOptionMacro(
  vtkScatteredSliceFilter, Regularize, vtkTypeBool, isopoint::option::regularize);

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

void vtkScatteredSliceFilter::AddNearestArray(const char* name)
{
  if (vtkAddIsopointName(this->NearestArrays, name))
  {
    this->Modified();
  }
}

void vtkScatteredSliceFilter::ClearNearestArrays()
{
  if (vtkClearIsopointNames(this->NearestArrays))
  {
    this->Modified();
  }
}

int vtkScatteredSliceFilter::GetNumberOfNearestArrays()
{
  return static_cast<int>(this->NearestArrays.size());
}

const char* vtkScatteredSliceFilter::GetNearestArray(int i)
{
  return vtkGetIsopointName(this->NearestArrays, i);
}

vtkMTimeType vtkScatteredSliceFilter::GetMTime()
{
  return std::max(
    this->Superclass::GetMTime(), this->CutFunction ? this->CutFunction->GetMTime() : 0);
}

const isopoint::Report& vtkScatteredSliceFilter::GetReport() const
{
  return this->Slicing->GetReport();
}

int vtkScatteredSliceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkIsopointSlicing::Options options{ *this->Options, this->CutFunction };
  options.Nearest = this->NearestArrays;
  if (this->Interpolation != LINEAR)
  {
    options.Method =
      this->Interpolation == FITS ? isopoint::PlaceMethod::Blend : isopoint::PlaceMethod::Nearest;
  }
  this->Slicing->Run(
    options, inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
  return 1;
}

void vtkScatteredSliceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CutFunction: " << this->CutFunction.Get() << "\n";
  os << indent << "Interpolation: " << this->Interpolation << "\n";
  vtkPrintIsopointNames(os, indent, "NearestArrays", this->NearestArrays);
}
