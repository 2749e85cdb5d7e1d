// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointOutputArrays.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Options.h"
#include "Core/OutputArrays.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAbstractArray.h"
#include "vtkArrayDispatch.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSetGet.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <type_traits>

namespace
{

using isopoint::ExtractedIsosurface;
using isopoint::IsopointEdge;
using isopoint::Isosurface;

void interpolateArray(const isopoint::Execution& execution, const Isosurface& surface,
  vtkDataArray* input, vtkDataArray* output, vtkIdType firstTuple)
{
  // Arrays that VTK can dispatch, in parallel. Their classes may differ: NewInstance() of an
  // implicit array yields another.
  const auto interpolateTyped = [&](auto* from, auto* to)
  {
    using T = typename std::decay_t<decltype(*to)>::ValueType;
    isopoint::interpolateComponents(
      execution, surface, from->GetNumberOfComponents(),
      [&](std::uint64_t sample, int component) {
        return static_cast<double>(
          from->GetTypedComponent(static_cast<vtkIdType>(sample), component));
      },
      [&](std::size_t i, int component, double value)
      {
        to->SetTypedComponent(
          firstTuple + static_cast<vtkIdType>(i), component, isopoint::toArrayType<T>(value));
      });
  };
  if (vtkArrayDispatch::Dispatch2SameValueType::Execute(input, output, interpolateTyped))
  {
    return;
  }
  isopoint::interpolateComponents(
    isopoint::Execution(), surface, input->GetNumberOfComponents(),
    [&](std::uint64_t sample, int component)
    { return input->GetComponent(static_cast<vtkIdType>(sample), component); },
    [&](std::size_t i, int component, double value)
    { vtkSetIsopointNumber(output, firstTuple + static_cast<vtkIdType>(i), component, value); });
}

/// Copies the tuples of the nearer ends.
void copyFromNearerEnd(const Isosurface& surface, vtkAbstractArray* input, vtkAbstractArray* output,
  vtkIdType firstTuple)
{
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    const IsopointEdge& edge = surface.edgeOf(i);
    const std::uint64_t nearer = edge.parameter < 0.5 ? edge.first : edge.second;
    output->SetTuple(firstTuple + static_cast<vtkIdType>(i), static_cast<vtkIdType>(nearer), input);
  }
}

bool isExcluded(vtkAbstractArray* array, int attribute, vtkDataArray* contoured)
{
  return array == contoured || attribute == vtkDataSetAttributes::GLOBALIDS ||
         array->GetNumberOfTuples() != contoured->GetNumberOfTuples() ||
         vtkIsGhostArrayName(array->GetName());
}

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

void vtkInterpolateIsopointArrays(const isopoint::Execution& execution, vtkDataSetAttributes* input,
  vtkDataArray* contoured, const std::vector<ExtractedIsosurface>& surfaces, vtkPointData* output)
{
  for (int index = 0; index < input->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* const array = input->GetAbstractArray(index);
    const int attribute = input->IsArrayAnAttribute(index);
    if (isExcluded(array, attribute, contoured))
    {
      continue;
    }
    const vtkSmartPointer<vtkAbstractArray> result =
      vtkNewArrayLike(array, static_cast<vtkIdType>(isopoint::countIsopoints(surfaces)));
    auto* const numbers = vtkDataArray::SafeDownCast(array);
    const bool isNumeric = numbers && !vtkHasIsopointIds(numbers, attribute);
    vtkIdType firstTuple = 0;
    for (const ExtractedIsosurface& extracted : surfaces)
    {
      const Isosurface& surface = extracted.surface;
      if (isNumeric)
      {
        interpolateArray(
          execution, surface, numbers, vtkDataArray::SafeDownCast(result), firstTuple);
        if (!extracted.areCaps.empty())
        {
          isopoint::forEachAtSample(isopoint::Execution(), surface,
            [&](std::size_t i, std::uint64_t sample)
            {
              result->SetTuple(
                firstTuple + static_cast<vtkIdType>(i), static_cast<vtkIdType>(sample), array);
            });
        }
      }
      else
      {
        copyFromNearerEnd(surface, array, result, firstTuple);
      }
      firstTuple += static_cast<vtkIdType>(surface.size());
    }
    vtkAddAttribute(attribute, result, output);
  }
}

void vtkSetIsopointNumber(vtkDataArray* array, vtkIdType tuple, int component, double number)
{
  switch (array->GetDataType())
  {
    // Not by SetComponent(), whose conversion from double overflows at the ends of 64-bit types.
    vtkTemplateMacro({
      const auto value = isopoint::toArrayType<VTK_TT>(number);
      if (auto* const typed = vtkAOSDataArrayTemplate<VTK_TT>::FastDownCast(array))
      {
        typed->SetTypedComponent(tuple, component, value);
      }
      else
      {
        array->SetVariantValue(
          tuple * array->GetNumberOfComponents() + component, vtkVariant(value));
      }
    });
    default: // bits
      array->SetComponent(tuple, component, std::clamp(std::round(number), 0.0, 1.0));
  }
}

void vtkAddContouredArray(
  vtkDataArray* contoured, const std::vector<ExtractedIsosurface>& surfaces, vtkPointData* output)
{
  const int type = contoured->GetDataType();
  const auto result = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(type == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE));
  result->SetName(contoured->GetName());
  vtkAllocateTuples(result, static_cast<vtkIdType>(isopoint::countIsopoints(surfaces)));
  vtkIdType tuple = 0;
  for (const ExtractedIsosurface& extracted : surfaces)
  {
    const Isosurface& surface = extracted.surface;
    const isopoint::CoincidentAttribute valueAt(surface, [contoured](std::uint64_t sample)
      { return contoured->GetComponent(static_cast<vtkIdType>(sample), 0); });
    for (std::size_t i = 0; i < surface.size(); ++i)
    {
      const IsopointEdge& edge = surface.edgeOf(i);
      result->SetComponent(tuple++, 0, edge.isSample() ? valueAt(edge.first) : surface.isovalue);
    }
  }
  vtkAddAttribute(vtkDataSetAttributes::SCALARS, result, output);
}

std::vector<std::string> vtkAddComputedIsopointArrays(const isopoint::Execution& execution,
  const isopoint::Options& options, const std::vector<ExtractedIsosurface>& surfaces,
  vtkPolyData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const bool hasSplats = options.computeSplats;
  isopoint::OutputArrays memory;
  const auto normals =
    newArray<vtkFloatArray>(options.computeNormals, "Normals", 3, count, memory.normals);
  const auto radii = newArray<vtkFloatArray>(hasSplats, vtkRadiusArrayName, 1, count, memory.radii);
  const auto gradients =
    newArray<vtkFloatArray>(options.computeGradients, "Gradients", 3, count, memory.gradients);
  const auto orders = newArray<vtkUnsignedCharArray>(
    options.computeProjectionOrders, "ProjectionOrder", 1, count, memory.projectionOrders);
  const auto axes =
    newArray<vtkFloatArray>(hasSplats, vtkSplatAxisArrayName, 3, count, memory.splatAxes);
  const auto polygons = newArray<vtkFloatArray>(hasSplats, vtkSplatPolygonArrayName,
    static_cast<int>(isopoint::numbersOfSplat), count, memory.splatPolygons);
  std::size_t first = 0;
  for (const ExtractedIsosurface& surface : surfaces)
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
