// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointComputedArrays.h"

#include "Core/Options.h"
#include "Core/OutputArrays.h"
#include "Input/vtkIsopointAllocation.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <cstddef>
#include <initializer_list>

namespace
{

/// A new array, or null if it is not to be computed.
template <class TArray>
vtkSmartPointer<TArray> newArray(
  bool isComputed, const char* name, int components, vtkIdType tuples)
{
  if (!isComputed)
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<TArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  vtkAllocateTuples(array, tuples);
  return array;
}

/// The values of an array, or null.
template <class TArray>
auto valuesOf(const vtkSmartPointer<TArray>& array)
{
  return array ? array->GetPointer(0) : nullptr;
}

} // namespace

vtkIsopointComputedArrays::vtkIsopointComputedArrays(
  const isopoint::Options& options, vtkIdType count)
  : IsProjected(options.projection != 0)
  , Normals(newArray<vtkFloatArray>(options.computeNormals, "Normals", 3, count))
  , Radius(newArray<vtkFloatArray>(options.computeSplats, "Radius", 1, count))
  , SplatAxis(newArray<vtkFloatArray>(options.computeSplats, "SplatAxis", 3, count))
  , SplatPolygon(newArray<vtkFloatArray>(
      options.computeSplats, "SplatPolygon", static_cast<int>(isopoint::polygonNumbers), count))
  , Gradients(newArray<vtkFloatArray>(options.computeGradients, "Gradients", 3, count))
  , ProjectionOrder(
      newArray<vtkUnsignedCharArray>(options.computeProjectionOrders, "ProjectionOrder", 1, count))
{
}

void vtkIsopointComputedArrays::Write(
  const isopoint::Execution& execution, const std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  isopoint::OutputArrays arrays;
  arrays.normals = valuesOf(this->Normals);
  arrays.radii = valuesOf(this->Radius);
  arrays.splatAxes = valuesOf(this->SplatAxis);
  arrays.splatPolygons = valuesOf(this->SplatPolygon);
  arrays.gradients = valuesOf(this->Gradients);
  arrays.projectionOrders = valuesOf(this->ProjectionOrder);
  std::size_t first = 0;
  for (const isopoint::ExtractedIsosurface& surface : surfaces)
  {
    isopoint::writeArrays(execution, surface, this->IsProjected, first, arrays);
    first += surface.surface.size();
  }
}

std::vector<std::string> vtkIsopointComputedArrays::AddTo(vtkPolyData* output) const
{
  vtkPointData* const pointData = output->GetPointData();
  std::vector<std::string> replaced;
  for (vtkDataArray* const array : std::initializer_list<vtkDataArray*>{
         this->Normals, this->Radius, this->Gradients, this->ProjectionOrder })
  {
    if (!array)
    {
      continue;
    }
    if (pointData->HasArray(array->GetName()))
    {
      replaced.emplace_back(array->GetName());
    }
    if (array == this->Normals)
    {
      pointData->SetNormals(array);
    }
    else
    {
      pointData->AddArray(array);
    }
  }
  if (this->SplatPolygon)
  {
    vtkCellData* const cellData = output->GetCellData();
    cellData->SetVectors(this->SplatAxis); // transforms of points turn active vectors
    cellData->AddArray(this->SplatPolygon);
    for (vtkFloatArray* const array : { this->SplatAxis.Get(), this->SplatPolygon.Get() })
    {
      array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    }
  }
  return replaced;
}
