// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointComputedArrays.h"

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
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

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>

namespace
{

constexpr int polygonNumbers = 5 * static_cast<int>(isopoint::mostCorners);

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

/// A radius as float, clamped to its positive range.
float asFloatRadius(double radius)
{
  using Limits = std::numeric_limits<float>;
  return static_cast<float>(
    std::clamp<double>(radius, Limits::denorm_min(), static_cast<double>(Limits::max())));
}

void set(vtkDataArray* array, vtkIdType tuple, const double* values)
{
  if (array)
  {
    array->SetTuple(tuple, values);
  }
}

} // namespace

vtkIsopointComputedArrays::vtkIsopointComputedArrays(const Choice& choice, vtkIdType count)
  : Chosen(choice)
  , Normals(newArray<vtkFloatArray>(choice.Normals, "Normals", 3, count))
  , Radius(newArray<vtkFloatArray>(choice.Splats, "Radius", 1, count))
  , SplatAxis(newArray<vtkFloatArray>(choice.Splats, "SplatAxis", 3, count))
  , SplatPolygon(newArray<vtkFloatArray>(choice.Splats, "SplatPolygon", polygonNumbers, count))
  , Gradients(newArray<vtkFloatArray>(choice.Gradients, "Gradients", 3, count))
  , ProjectionOrder(
      newArray<vtkUnsignedCharArray>(choice.ProjectionOrder, "ProjectionOrder", 1, count))
{
}

void vtkIsopointComputedArrays::Append(
  const isopoint::Execution& execution, const isopoint::ExtractedIsosurface& extracted)
{
  const std::vector<isopoint::LocalFit>& fits = extracted.surface.fits;
  std::atomic<vtkIdType> withoutFit{ 0 };
  isopoint::forEachIndex(execution, extracted.surface.size(),
    [&](std::size_t i)
    {
      const vtkIdType tuple = this->Next + static_cast<vtkIdType>(i);
      if (!extracted.splats.empty())
      {
        this->SetSplat(tuple, extracted.splats[i]);
      }
      if (!extracted.normals.empty())
      {
        set(this->Normals, tuple, extracted.normals[i].data());
      }
      if (!fits.empty())
      {
        this->SetFit(tuple, fits[i]);
        if (!fits[i].order && (extracted.areElsewhere.empty() || !extracted.areElsewhere[i]))
        {
          ++withoutFit;
        }
      }
    });
  this->Next += static_cast<vtkIdType>(extracted.surface.size());
  this->WithoutFit += withoutFit;
}

void vtkIsopointComputedArrays::SetSplat(vtkIdType tuple, const isopoint::Splat& splat)
{
  const double radius = asFloatRadius(splat.radius);
  set(this->Normals, tuple, splat.normal.data());
  set(this->Radius, tuple, &radius);
  set(this->SplatAxis, tuple, splat.axis.data());
  if (this->SplatPolygon)
  {
    float* next = this->SplatPolygon->GetPointer(polygonNumbers * tuple);
    for (const isopoint::SplatCorner& corner : splat.corners)
    {
      for (const float number :
        { corner.along, corner.across, corner.height, corner.slopeAlong, corner.slopeAcross })
      {
        *next++ = number;
      }
    }
  }
}

void vtkIsopointComputedArrays::SetFit(vtkIdType tuple, const isopoint::LocalFit& fit)
{
  const double order =
    this->Chosen.IsProjected && fit.order ? static_cast<double>(*fit.order) : 0.0;
  set(this->Gradients, tuple, fit.gradient.data());
  set(this->ProjectionOrder, tuple, &order);
}

std::vector<std::string> vtkIsopointComputedArrays::AddTo(vtkPolyData* output) const
{
  vtkPointData* const pointData = output->GetPointData();
  std::vector<std::string> replaced;
  for (vtkDataArray* const array :
    { this->Normals.Get(), this->Radius.Get(), this->Gradients.Get(), this->ProjectionOrder.Get() })
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
  if (this->Chosen.Splats)
  {
    vtkCellData* const cellData = output->GetCellData();
    cellData->SetVectors(this->SplatAxis); // transforms of points turn active vectors
    cellData->AddArray(this->SplatPolygon);
    for (vtkDataArray* const array :
      { this->SplatAxis.Get(), static_cast<vtkDataArray*>(this->SplatPolygon.Get()) })
    {
      array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    }
  }
  return replaced;
}
