// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointComputedArrays.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Options.h"
#include "Core/OutputArrays.h"

#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstddef>
#include <initializer_list>

namespace
{

/// A new array, or null unless `isComputed`.
/// @param values receives its memory, or null
template <class TArray>
vtkSmartPointer<TArray> newArray(bool isComputed, const char* name, int components,
  vtkIdType tuples, typename TArray::ValueType*& values)
{
  if (!isComputed)
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<TArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  vtkAllocateTuples(array, tuples);
  values = array->GetPointer(0);
  return array;
}

} // namespace

std::vector<std::string> vtkAddComputedIsopointArrays(const isopoint::Execution& execution,
  const isopoint::Options& options, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPolyData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const bool hasSplats = options.computeSplats;
  isopoint::OutputArrays memory;
  const auto normals =
    newArray<vtkFloatArray>(options.computeNormals, "Normals", 3, count, memory.normals);
  const auto radii = newArray<vtkFloatArray>(hasSplats, "Radius", 1, count, memory.radii);
  const auto gradients =
    newArray<vtkFloatArray>(options.computeGradients, "Gradients", 3, count, memory.gradients);
  const auto orders = newArray<vtkUnsignedCharArray>(
    options.computeProjectionOrders, "ProjectionOrder", 1, count, memory.projectionOrders);
  const auto axes = newArray<vtkFloatArray>(hasSplats, "SplatAxis", 3, count, memory.splatAxes);
  const auto polygons = newArray<vtkFloatArray>(hasSplats, "SplatPolygon",
    static_cast<int>(isopoint::numbersOfSplat), count, memory.splatPolygons);
  std::size_t first = 0;
  for (const isopoint::ExtractedIsosurface& surface : surfaces)
  {
    isopoint::writeArrays(execution, surface, options.projection != 0, first, memory);
    first += surface.surface.size();
  }

  vtkPointData* const pointData = output->GetPointData();
  std::vector<std::string> replaced;
  for (vtkDataArray* const array :
    std::initializer_list<vtkDataArray*>{ normals, radii, gradients, orders })
  {
    if (array)
    {
      if (pointData->HasArray(array->GetName()))
      {
        replaced.emplace_back(array->GetName());
      }
      pointData->AddArray(array);
    }
  }
  if (normals)
  {
    pointData->SetActiveNormals(normals->GetName());
  }
  if (hasSplats)
  {
    vtkCellData* const cellData = output->GetCellData();
    cellData->SetVectors(axes); // transforms of points rotate active vectors
    cellData->AddArray(polygons);
    for (vtkFloatArray* const array : { axes.Get(), polygons.Get() })
    {
      array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    }
  }
  return replaced;
}
