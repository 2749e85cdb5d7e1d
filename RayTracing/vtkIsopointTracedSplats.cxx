// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedActor.h"

#include "vtkIsopointSplatBlocks.h"
#include "vtkIsopointSplatBounds.h"
#include "vtkIsopointSplatMapper.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace
{

using Triple = std::array<double, 3>;

bool isFinite(const Triple& vector)
{
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

raytracing::Vector vectorOf(const Triple& triple)
{
  return vtkIsopointTracedVector(triple.data());
}

/// At length 1; zeros where there is no direction.
Triple unitOf(const Triple& vector)
{
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return { 0.0, 0.0, 0.0 };
  }
  return { vector[0] / length, vector[1] / length, vector[2] / length };
}

double dot(const Triple& a, const Triple& b)
{
  return vtkMath::Dot(a.data(), b.data());
}

Triple cross(const Triple& a, const Triple& b)
{
  Triple result;
  vtkMath::Cross(a.data(), b.data(), result.data());
  return result;
}

Triple scaled(double factor, const Triple& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

Triple tupleOf(vtkDataArray* array, vtkIdType index)
{
  Triple result;
  array->GetTuple(index, result.data());
  return result;
}

vtkDataArray* usable(vtkPolyData* data, vtkDataArray* array, int components)
{
  return array && array->GetNumberOfComponents() == components &&
             array->GetNumberOfTuples() >= data->GetNumberOfPoints()
           ? array
           : nullptr;
}

vtkDataArray* arrayOf(vtkPolyData* data, const char* name, int components)
{
  vtkDataArray* const array = name && name[0] ? data->GetPointData()->GetArray(name) : nullptr;
  return usable(data, array, components);
}

/// The arrays of one block, as the mapper reads them.
struct Arrays
{
  Arrays(vtkIsopointSplatMapper* mapper, vtkPolyData* data)
    : Normals(usable(data, data->GetPointData()->GetNormals(), 3))
    , Radii(arrayOf(data, mapper->GetRadiusArrayName(), 1))
    , Radius(mapper->GetRadius())
  {
    if (!this->Radii && !(this->Radius > 0.0))
    {
      this->Radius = vtkIsopointSplatBounds::AutomaticRadius(data->GetPoints());
    }
    if (mapper->GetShape() == vtkIsopointSplatMapper::ELLIPSE)
    {
      this->Axis1 = arrayOf(data, mapper->GetSplatAxis1ArrayName(), 3);
      this->Axis2 = arrayOf(data, mapper->GetSplatAxis2ArrayName(), 3);
    }
    this->Clips = arrayOf(data, mapper->GetSplatClipArrayName(), 5);
    if (!this->Clips)
    {
      this->Clips = arrayOf(data, mapper->GetSplatClipArrayName(), 4);
    }
    this->Ghosts = data->GetPointGhostArray();
  }

  bool HasEllipses() const { return this->Axis1 && this->Axis2; }

  vtkDataArray* Normals;
  vtkDataArray* Radii;
  double Radius;
  vtkDataArray* Axis1 = nullptr;
  vtkDataArray* Axis2 = nullptr;
  vtkDataArray* Clips = nullptr;
  vtkUnsignedCharArray* Ghosts = nullptr;
};

/// Adds the splats of blocks to a surface.
class Collector
{
public:
  Collector(raytracing::Splats& splats, const vtkIsopointTracedPlacement& placement,
    const vtkIsopointTracedSettings& settings, vtkIsopointSplatMapper* mapper)
    : Splats(splats)
    , Placement(placement)
    , Settings(settings)
    , Mapper(mapper)
    , Scale(mapper->GetRadiusScale())
  {
  }

  void Add(vtkActor* actor, const vtkIsopointSplatLeaf& leaf, bool hasEllipses, bool hasClips,
    bool hasColors)
  {
    const Arrays arrays(this->Mapper, leaf.Data);
    int cellFlag = 0;
    const auto colors =
      leaf.HasColor ? nullptr : vtkIsopointTracedColors(this->Mapper, leaf.Data, cellFlag);
    const raytracing::Color plain = vtkIsopointTracedColor(actor, leaf);
    const auto byte = [](float value)
    { return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); };
    const raytracing::ColorBytes plainBytes = { byte(plain.x), byte(plain.y), byte(plain.z), 255 };
    for (vtkIdType i = 0; i < leaf.Data->GetNumberOfPoints(); ++i)
    {
      if (!this->AddShape(leaf.Data, arrays, i, hasEllipses, hasClips))
      {
        continue;
      }
      if (hasColors)
      {
        raytracing::ColorBytes bytes = plainBytes;
        if (colors && cellFlag == 0 && i < colors->GetNumberOfTuples())
        {
          colors->GetTypedTuple(i, bytes.data());
        }
        this->Splats.colors.push_back(bytes);
      }
    }
  }

private:
  bool AddShape(
    vtkPolyData* data, const Arrays& arrays, vtkIdType i, bool hasEllipses, bool hasClips)
  {
    Triple position;
    data->GetPoint(i, position.data());
    double modelRadius = arrays.Radius;
    if (arrays.Radii)
    {
      arrays.Radii->GetTuple(i, &modelRadius);
    }
    modelRadius *= this->Scale;
    constexpr int unseen = vtkDataSetAttributes::HIDDENPOINT | vtkDataSetAttributes::DUPLICATEPOINT;
    const int ghost =
      arrays.Ghosts && i < arrays.Ghosts->GetNumberOfTuples() ? arrays.Ghosts->GetValue(i) : 0;
    if (!isFinite(position) || !std::isfinite(modelRadius) || !(modelRadius > 0.0) ||
        (ghost & unseen) != 0)
    {
      return false;
    }
    const Triple center = this->Placement.Point(position.data());
    const double radius = modelRadius * this->Placement.GetScale();
    Triple normal = { 0.0, 0.0, 0.0 };
    if (arrays.Normals)
    {
      normal = unitOf(this->Placement.Normal(tupleOf(arrays.Normals, i).data()));
    }
    if (!isFinite(normal) || !(dot(normal, normal) > 0.0))
    {
      const Triple& camera = this->Settings.CameraPosition;
      normal = unitOf({ camera[0] - center[0], camera[1] - center[1], camera[2] - center[2] });
    }
    Triple plane = normal;
    double reach = radius;
    raytracing::Ellipse ellipse = this->DiscEllipse(normal, radius);
    if (arrays.HasEllipses())
    {
      this->SetEllipse(tupleOf(arrays.Axis1, i), tupleOf(arrays.Axis2, i), plane, reach, ellipse);
    }
    if (!(static_cast<float>(reach) > 0.0f) || !std::isfinite(static_cast<float>(reach)))
    {
      return false;
    }
    this->Splats.discs.push_back({ vectorOf(center), static_cast<float>(reach) });
    this->Splats.planes.push_back(vectorOf(plane));
    if (hasEllipses)
    {
      this->Splats.normals.push_back(vectorOf(normal));
      this->Splats.ellipses.push_back(ellipse);
      this->Splats.depths.push_back(static_cast<float>(radius));
    }
    if (hasClips)
    {
      this->Splats.clips.push_back(this->ClipOf(arrays, i, modelRadius));
    }
    return true;
  }

  static raytracing::Ellipse DiscEllipse(const Triple& normal, double radius)
  {
    const raytracing::Frame frame(vectorOf(normal));
    const float factor = static_cast<float>(1.0 / radius);
    return { factor * frame.first, factor * frame.second };
  }

  /// Leaves plane, reach and ellipse as they are where the axes span no plane.
  void SetEllipse(const Triple& modelAxis1, const Triple& modelAxis2, Triple& plane, double& reach,
    raytracing::Ellipse& ellipse) const
  {
    const Triple a = scaled(this->Scale, this->Placement.Offset(modelAxis1.data()));
    const Triple b = scaled(this->Scale, this->Placement.Offset(modelAxis2.data()));
    const Triple normal = unitOf(cross(a, b));
    const double aa = dot(a, a);
    const double bb = dot(b, b);
    const double ab = dot(a, b);
    const double determinant = aa * bb - ab * ab;
    if (!isFinite(a) || !isFinite(b) || !(determinant > 0.0) || !(dot(normal, normal) > 0.0))
    {
      return;
    }
    plane = dot(normal, plane) < 0.0 ? scaled(-1.0, normal) : normal;
    // Half the longest axis of the ellipse that a and b are conjugate half-axes of.
    const double half = 0.5 * (aa + bb);
    reach = std::sqrt(half + std::sqrt(std::max(half * half - determinant, 0.0)));
    Triple first;
    Triple second;
    for (std::size_t axis = 0; axis < first.size(); ++axis)
    {
      first[axis] = (bb * a[axis] - ab * b[axis]) / determinant;
      second[axis] = (aa * b[axis] - ab * a[axis]) / determinant;
    }
    ellipse = { vectorOf(first), vectorOf(second) };
  }

  raytracing::Clip ClipOf(const Arrays& arrays, vtkIdType i, double modelRadius) const
  {
    raytracing::Clip clip;
    if (!arrays.Clips)
    {
      return clip;
    }
    double values[5] = { 0.0, 0.0, 0.0, 0.0, -1.0 };
    arrays.Clips->GetTuple(i, values);
    // Distances of planes do not grow with RadiusScale.
    const double length = std::hypot(values[0], values[1], values[2]) * modelRadius;
    const Triple normal = this->Placement.Normal(values);
    if (!(length > 0.0) || !isFinite(normal) || !std::isfinite(values[3] / length))
    {
      return clip;
    }
    clip.normal = vectorOf(scaled(1.0 / length, normal));
    clip.distance = static_cast<float>(values[3] / length);
    clip.turn = values[4] > 0.0 ? 1.0f : -1.0f;
    return clip;
  }

  raytracing::Splats& Splats;
  const vtkIsopointTracedPlacement& Placement;
  const vtkIsopointTracedSettings& Settings;
  vtkIsopointSplatMapper* Mapper;
  double Scale;
};

} // namespace

//------------------------------------------------------------------------------
std::shared_ptr<raytracing::Splats> vtkIsopointTracedSplats(vtkActor* actor,
  vtkIsopointSplatMapper* mapper, const vtkIsopointTracedSettings& settings,
  const vtkIsopointTracedFrame& frame)
{
  const vtkIsopointTracedPlacement placement(actor->GetMatrix(), frame);
  std::vector<vtkIsopointSplatLeaf> leaves = vtkIsopointSplatLeaves(
    mapper->GetInputDataObject(0, 0), mapper->GetCompositeDataDisplayAttributes());
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(),
                 [](const vtkIsopointSplatLeaf& leaf) { return !leaf.Visible; }),
    leaves.end());
  if (placement.GetIsSingular() || leaves.empty())
  {
    return nullptr;
  }
  bool hasEllipses = false;
  bool hasClips = false;
  bool hasColors = mapper->GetScalarVisibility() != 0;
  for (const vtkIsopointSplatLeaf& leaf : leaves)
  {
    const Arrays arrays(mapper, leaf.Data);
    hasEllipses = hasEllipses || arrays.HasEllipses();
    hasClips = hasClips || arrays.Clips != nullptr;
    hasColors = hasColors || leaf.HasColor;
  }
  const auto splats = std::make_shared<raytracing::Splats>();
  splats->material = vtkIsopointTracedMaterial(actor, settings, frame);
  splats->color = vtkIsopointTracedColor(actor, leaves.front());
  splats->blendDepth = static_cast<float>(mapper->GetBlendDepth());
  Collector collector(*splats, placement, settings, mapper);
  for (const vtkIsopointSplatLeaf& leaf : leaves)
  {
    collector.Add(actor, leaf, hasEllipses, hasClips, hasColors);
  }
  splats->outward = raytracing::orientationOf(*splats);
  return splats;
}
