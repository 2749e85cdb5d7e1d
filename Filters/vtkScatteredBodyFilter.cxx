// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredBodyFilter.h"

#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointSlicing.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <limits>

vtkStandardNewMacro(vtkScatteredBodyFilter);

vtkScatteredBodyFilter::vtkScatteredBodyFilter()
  : Slicing(std::make_unique<vtkIsopointSlicing>(*this->Updater))
{
  this->SetProgressText("Scattered Body"); // as in ParaView's menu
  this->ContourValues->SetValue(0, -std::numeric_limits<double>::infinity());
  this->Options->Core = vtkIsopointSlicing::OptionsOfCore();
  this->Options->Core.capping = true;
}

vtkScatteredBodyFilter::~vtkScatteredBodyFilter() = default;

vtkIsopointOptionMacro(
  vtkScatteredBodyFilter, MinimumPieceSize, double, isopoint::option::minimumPieceSize);

const isopoint::Report& vtkScatteredBodyFilter::GetReport() const
{
  return this->Slicing->GetReport();
}

int vtkScatteredBodyFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Slicing->Run({ *this->Options }, inputVector[0]->GetInformationObject(0),
    outputVector->GetInformationObject(0));
  return 1;
}
