// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredBodyFilter.h"

#include "Update/vtkIsopointSlicing.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <limits>

vtkStandardNewMacro(vtkScatteredBodyFilter);

vtkScatteredBodyFilter::vtkScatteredBodyFilter()
  : Slicing(std::make_unique<vtkIsopointSlicing>(*this->Updater))
{
  this->SetProgressText("Scattered Body"); // as in ParaView's menu
}

vtkScatteredBodyFilter::~vtkScatteredBodyFilter() = default;

vtkPolyData* vtkScatteredBodyFilter::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

const isopoint::SampleCounts& vtkScatteredBodyFilter::GetSampleCounts() const
{
  return this->Slicing->GetReport();
}

vtkIdType vtkScatteredBodyFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->Slicing->GetReport().pointCount());
}

vtkSmartPointer<vtkDataObject> vtkScatteredBodyFilter::NewOutput(vtkInformationVector**)
{
  return vtkSmartPointer<vtkPolyData>::New();
}

int vtkScatteredBodyFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkIsopointSlicing::Options options;
  options.Offsets = { -std::numeric_limits<double>::infinity() };
  options.Core.triangles = true;
  options.Core.capping = true;
  options.Core.projection = 0;
  options.Core.computeNormals = false;
  options.Core.computeSplats = false;
  options.Core.keepTetrahedra = this->GetKeepTree() != 0;
  options.Core.dropGaps = this->DropGaps != 0;
  options.Core.minimumPieceSize = this->MinimumPieceSize;
  options.Core.outputPointsPrecision = this->OutputPointsPrecision;
  this->Slicing->Run(
    options, inputVector[0]->GetInformationObject(0), outputVector->GetInformationObject(0));
  return 1;
}

void vtkScatteredBodyFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DropGaps: " << this->DropGaps << "\n";
  os << indent << "MinimumPieceSize: " << this->MinimumPieceSize << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
}
