// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkScatteredSurfaceFilter.h"

#include "Update/vtkIsopointOptions.h"
#include "Update/vtkIsopointUpdate.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <type_traits>

vtkScatteredSurfaceFilter::vtkScatteredSurfaceFilter()
  : Options(std::make_unique<vtkIsopointOptions>())
{
  this->Options->ContourValues = this->ContourValues;
}

vtkScatteredSurfaceFilter::~vtkScatteredSurfaceFilter() = default;

vtkIsopointOptionMacro(
  vtkScatteredSurfaceFilter, DropGaps, vtkTypeBool, isopoint::option::dropGaps);
vtkIsopointOptionMacro(
  vtkScatteredSurfaceFilter, OutputPointsPrecision, int, isopoint::option::outputPointsPrecision);

vtkPolyData* vtkScatteredSurfaceFilter::GetOutput(int port)
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port));
}

vtkSmartPointer<vtkDataObject> vtkScatteredSurfaceFilter::NewOutput(vtkInformationVector**)
{
  return vtkSmartPointer<vtkPolyData>::New();
}

vtkMTimeType vtkScatteredSurfaceFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

const isopoint::SampleCounts& vtkScatteredSurfaceFilter::GetSampleCounts() const
{
  return this->GetReport();
}

vtkIdType vtkScatteredSurfaceFilter::GetNumberOfExtractedPoints() const
{
  return static_cast<vtkIdType>(this->GetReport().pointCount());
}

void vtkScatteredSurfaceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Contour values:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  const isopoint::Options& core = this->Options->Core;
  isopoint::forEffectiveOptions(core,
    [&](const auto& option)
    {
      os << indent << option.name << ": ";
      if constexpr (std::is_same_v<std::decay_t<decltype(core.*option.value)>, bool>)
      {
        os << (core.*option.value ? "On\n" : "Off\n");
      }
      else
      {
        os << core.*option.value << "\n";
      }
    });
  os << indent << "NumberOfExtractedPoints: " << this->GetNumberOfExtractedPoints() << "\n";
}
