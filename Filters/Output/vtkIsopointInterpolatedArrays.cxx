// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointInterpolatedArrays.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/OutputArrays.h"

#include "vtkAbstractArray.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace
{

using isopoint::ExtractedIsosurface;
using isopoint::IsopointEdge;
using isopoint::Isosurface;

/// Interpolates arrays that VTK can dispatch, in parallel.
struct TypedInterpolation
{
  const isopoint::Execution& Run;
  const Isosurface& Surface;
  vtkIdType FirstTuple;

  /// @param output its class may differ: NewInstance() of an implicit array yields another
  template <class TInput, class TOutput>
  void operator()(TInput* input, TOutput* output) const
  {
    using T = typename TOutput::ValueType;
    isopoint::interpolateComponents(
      this->Run, this->Surface, input->GetNumberOfComponents(),
      [&](std::uint64_t sample, int component)
      {
        return static_cast<double>(
          input->GetTypedComponent(static_cast<vtkIdType>(sample), component));
      },
      [&](std::size_t i, int component, double value)
      {
        output->SetTypedComponent(
          this->FirstTuple + static_cast<vtkIdType>(i), component, isopoint::toArrayType<T>(value));
      });
  }
};

void interpolateArray(const isopoint::Execution& execution, const Isosurface& surface,
  vtkDataArray* input, vtkDataArray* output, vtkIdType firstTuple)
{
  const TypedInterpolation typed{ execution, surface, firstTuple };
  if (vtkArrayDispatch::Dispatch2SameValueType::Execute(input, output, typed))
  {
    return;
  }
  isopoint::interpolateComponents(
    isopoint::Execution(), surface, input->GetNumberOfComponents(),
    [&](std::uint64_t sample, int component)
    { return input->GetComponent(static_cast<vtkIdType>(sample), component); },
    [&](std::size_t i, int component, double value)
    { output->SetComponent(firstTuple + static_cast<vtkIdType>(i), component, value); });
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
         (array->GetName() &&
           std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) == 0);
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
    const bool isNumeric = numbers && attribute != vtkDataSetAttributes::PEDIGREEIDS;
    vtkIdType firstTuple = 0;
    for (const ExtractedIsosurface& extracted : surfaces)
    {
      const Isosurface& surface = extracted.surface;
      if (isNumeric)
      {
        interpolateArray(
          execution, surface, numbers, vtkDataArray::SafeDownCast(result), firstTuple);
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
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      result->SetComponent(tuple++, 0, extracted.surface.isovalue);
    }
  }
  vtkAddAttribute(vtkDataSetAttributes::SCALARS, result, output);
}
