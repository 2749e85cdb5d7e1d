// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointGeometry.h"

#include "vtkIsopointAllocation.h"

#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <limits>

namespace
{

/// An array, or null where it is not wanted.
template <class TArray>
vtkSmartPointer<vtkDataArray> newArray(
  bool isWanted, const char* name, int components, vtkIdType tuples)
{
  if (!isWanted)
  {
    return nullptr;
  }
  auto array = vtkSmartPointer<TArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  vtkAllocateTuples(array, tuples);
  return array;
}

/// A radius within float's range, whatever the coordinates' scale.
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

vtkIsopointGeometry::vtkIsopointGeometry(const Arrays& wanted, vtkIdType count)
  : Wanted(wanted)
  , Normals(newArray<vtkFloatArray>(wanted.Normals, "Normals", 3, count))
  , Radius(newArray<vtkFloatArray>(wanted.Radius, "Radius", 1, count))
  , SplatAxis1(newArray<vtkFloatArray>(wanted.SplatAxes, "SplatAxis1", 3, count))
  , SplatAxis2(newArray<vtkFloatArray>(wanted.SplatAxes, "SplatAxis2", 3, count))
  , SplatClip(newArray<vtkFloatArray>(wanted.SplatClip, "SplatClip", 5, count))
  , Gradients(newArray<vtkFloatArray>(wanted.Gradients, "Gradients", 3, count))
  , ProjectionOrder(
      newArray<vtkUnsignedCharArray>(wanted.ProjectionOrder, "ProjectionOrder", 1, count))
{
}

void vtkIsopointGeometry::Append(const isopoint::SurfacePoints& surface,
  const std::vector<isopoint::Splat>& splats, vtkPoints* points)
{
  for (std::size_t i = 0; i < surface.positions.size(); ++i, ++this->Next)
  {
    points->SetPoint(this->Next, surface.positions[i].data());
    if (!splats.empty())
    {
      const isopoint::Splat& splat = splats[i];
      set(this->Normals, this->Next, splat.normal.data());
      const double radius = asFloatRadius(splat.radius);
      set(this->Radius, this->Next, &radius);
      set(this->SplatAxis1, this->Next, splat.axis1.data());
      set(this->SplatAxis2, this->Next, splat.axis2.data());
      set(this->SplatClip, this->Next, splat.clip.data());
    }
    if (!surface.fits.empty())
    {
      const isopoint::LocalFit& fit = surface.fits[i];
      set(this->Gradients, this->Next, fit.gradient.data());
      this->WithoutFit += fit.order == isopoint::FitOrder::None ? 1 : 0;
      const double order = this->Wanted.IsProjected ? static_cast<double>(fit.order) : 0.0;
      set(this->ProjectionOrder, this->Next, &order);
    }
  }
}

std::vector<std::string> vtkIsopointGeometry::AddTo(vtkPointData* pointData) const
{
  std::vector<std::string> replaced;
  for (vtkDataArray* const array :
    { this->Normals.Get(), this->Radius.Get(), this->SplatAxis1.Get(), this->SplatAxis2.Get(),
      this->SplatClip.Get(), this->Gradients.Get(), this->ProjectionOrder.Get() })
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
  return replaced;
}
