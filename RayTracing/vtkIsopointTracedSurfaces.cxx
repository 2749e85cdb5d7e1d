// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedSurfaces.h"

#include "Core/Base/Vector.h"
#include "vtkIsopointCompositeMapper.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkIdList.h"
#include "vtkMapper.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkProperty.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleStrip.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>

namespace
{

/// Applies the attributes of a data object to itself or the blocks in it.
void applyAttributes(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
  std::vector<vtkIsopointTracedBlock>& blocks)
{
  const bool hasVisibility = attributes->HasBlockVisibility(object);
  const bool hasColor = attributes->HasBlockColor(object);
  if (!hasVisibility && !hasColor)
  {
    return;
  }
  const std::vector<vtkPolyData*> leaves = vtkCompositeDataSet::GetDataSets<vtkPolyData>(object);
  const std::set<vtkPolyData*> within(leaves.begin(), leaves.end());
  for (vtkIsopointTracedBlock& block : blocks)
  {
    if (within.count(block.Data) == 0)
    {
      continue;
    }
    if (hasVisibility)
    {
      block.Visible = attributes->GetBlockVisibility(object);
    }
    if (hasColor)
    {
      block.HasColor = true;
      attributes->GetBlockColor(object, block.Color.data());
    }
  }
}

} // namespace

std::vector<vtkIsopointTracedBlock> vtkGetTracedBlocks(vtkMapper* mapper)
{
  vtkDataObject* const input = mapper->GetInputDataObject(0, 0);
  std::vector<vtkIsopointTracedBlock> blocks;
  for (vtkPolyData* const data : vtkCompositeDataSet::GetDataSets<vtkPolyData>(input))
  {
    if (data->GetNumberOfPoints() > 0)
    {
      blocks.emplace_back();
      blocks.back().Data = data;
    }
  }
  const auto compositeMapper = vtkIsopointCompositeMapper::SafeDownCast(mapper);
  vtkCompositeDataDisplayAttributes* const attributes =
    compositeMapper ? compositeMapper->GetCompositeDataDisplayAttributes() : nullptr;
  vtkCompositeDataSet* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite || !attributes)
  {
    return blocks;
  }
  // The iterator visits outer blocks before inner ones, whose attributes take precedence.
  applyAttributes(composite, attributes, blocks);
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  if (const auto tree = vtkDataObjectTreeIterator::SafeDownCast(iterator))
  {
    tree->VisitOnlyLeavesOff();
  }
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    applyAttributes(iterator->GetCurrentDataObject(), attributes, blocks);
  }
  return blocks;
}

namespace
{

/// Transforms an actor's coordinates to those of the scene.
class Placement
{
public:
  Placement(vtkMatrix4x4* modelToWorld, const vtkIsopointTracedFrame& frame)
  {
    this->Matrix->DeepCopy(modelToWorld);
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        const double shift = column == 3 ? frame.Center[row] : 0.0;
        const double element = (modelToWorld->GetElement(row, column) - shift) / frame.Length;
        this->Matrix->SetElement(row, column, element);
        if (column < 3)
        {
          this->NormalMatrix->SetElement(row, column, element);
        }
      }
    }
    this->IsSingular = !(std::abs(this->NormalMatrix->Determinant()) > 0.0);
    this->NormalMatrix->Invert();
    this->NormalMatrix->Transpose();
  }

  /// Whether the actor's transform has no inverse, so that it cannot be placed.
  bool GetIsSingular() const { return this->IsSingular; }

  raytracing::Vector Point(const double* point) const
  {
    const double from[4] = { point[0], point[1], point[2], 1.0 };
    double to[4];
    this->Matrix->MultiplyPoint(from, to);
    return vtkToTracedVector(to);
  }

  raytracing::Vector Normal(const double* normal) const
  {
    double result[3];
    this->NormalMatrix->MultiplyPoint(normal, result);
    return raytracing::directionOf(vtkToTracedVector(result), { 0.0f, 0.0f, 0.0f });
  }

private:
  vtkNew<vtkMatrix4x4> Matrix;
  vtkNew<vtkMatrix3x3> NormalMatrix; // inverse transpose
  bool IsSingular = false;
};

/// The material for a property; see vtkIsopointRayTracer.
/// @param absorptionDistance in world units; 0: the actor's diagonal
raytracing::Material materialOf(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame)
{
  vtkProperty* const property = actor->GetProperty();
  raytracing::Material material;
  material.isPhysical = property->GetInterpolation() == VTK_PBR;
  material.opacity = static_cast<float>(property->GetOpacity());
  const bool isLit = property->GetLighting();
  material.ambient = isLit ? static_cast<float>(property->GetAmbient()) : 1.0f;
  material.diffuse = isLit ? static_cast<float>(property->GetDiffuse()) : 0.0f;
  material.specular = isLit ? static_cast<float>(property->GetSpecular()) : 0.0f;
  material.specularPower = static_cast<float>(property->GetSpecularPower());
  material.specularColor = vtkToTracedVector(property->GetSpecularColor());
  material.metallic = static_cast<float>(property->GetMetallic());
  material.roughness = static_cast<float>(property->GetRoughness());
  material.refractiveIndex = static_cast<float>(property->GetBaseIOR());
  const double distance = absorptionDistance > 0.0 ? absorptionDistance : actor->GetLength();
  constexpr double least = 1e-6;
  material.absorptionDistance = static_cast<float>(std::max(distance / frame.Length, least));
  return material;
}

/// The colors of a polydata's scalars, as a mapper maps them.
struct MappedColors
{
  vtkSmartPointer<vtkUnsignedCharArray> Colors; // null if there are none
  bool OfCells = false;                         // rather than of points
  vtkIdType Single = -1;                        // the tuple for all cells, or -1
};

/// Does not change the mapper.
MappedColors mappedColors(vtkMapper* mapper, vtkPolyData* data)
{
  // A copy of the mapper's settings, because mapping stores its result in the mapper.
  vtkNew<vtkOpenGLPolyDataMapper> colors;
  colors->vtkMapper::ShallowCopy(mapper);
  colors->SetInterpolateScalarsBeforeMapping(false);
  MappedColors mapped;
  int cellFlag = 0; // 0: points, 1: cells, 2: field data with one tuple per cell
  mapped.Colors = colors->MapScalars(data, 1.0, cellFlag);
  mapped.OfCells = cellFlag != 0;
  mapped.Single = cellFlag == 2 ? colors->GetFieldDataTupleId() : -1;
  return mapped;
}

/// The cells of a polydata as triangles, with the cell of each.
class Triangulation
{
public:
  explicit Triangulation(vtkPolyData* data)
    : Data(data)
  {
    vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines();
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    for (vtkIdType i = 0; i < data->GetPolys()->GetNumberOfCells(); ++i)
    {
      data->GetPolys()->GetCellAtId(i, count, points);
      this->AddPolygon(count, points, cell++);
    }
    for (vtkIdType i = 0; i < data->GetStrips()->GetNumberOfCells(); ++i)
    {
      data->GetStrips()->GetCellAtId(i, count, points);
      for (vtkIdType corner = 0; corner + 2 < count; ++corner)
      {
        const vtkIdType odd = corner % 2;
        this->Add(points[corner + odd], points[corner + 1 - odd], points[corner + 2], cell);
      }
      ++cell;
    }
  }

  std::vector<std::array<std::uint32_t, 3>> Triangles;
  std::vector<vtkIdType> Cells;

private:
  void Add(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType cell)
  {
    for (const vtkIdType corner : { a, b, c })
    {
      isopoint::Vector position;
      this->Data->GetPoint(corner, position.data());
      if (!isopoint::isFinite(position))
      {
        return;
      }
    }
    this->Triangles.push_back({ static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
      static_cast<std::uint32_t>(c) });
    this->Cells.push_back(cell);
  }

  void AddPolygon(vtkIdType count, const vtkIdType* points, vtkIdType cell)
  {
    if (count == 3)
    {
      this->Add(points[0], points[1], points[2], cell);
    }
    if (count <= 3)
    {
      return;
    }
    this->Polygon->Initialize(static_cast<int>(count), points, this->Data->GetPoints());
    this->Polygon->Triangulate(0, this->Corners, this->CornerPoints);
    for (vtkIdType i = 0; i + 2 < this->Corners->GetNumberOfIds(); i += 3)
    {
      this->Add(
        this->Corners->GetId(i), this->Corners->GetId(i + 1), this->Corners->GetId(i + 2), cell);
    }
  }

  vtkPolyData* Data;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> Corners;
  vtkNew<vtkPoints> CornerPoints;
};

void setColors(
  raytracing::Surface& surface, const Triangulation& triangulation, const MappedColors& mapped)
{
  const auto colorAt = [&mapped](vtkIdType element)
  {
    const vtkIdType tuple = mapped.Single >= 0 ? mapped.Single : element;
    raytracing::ColorBytes bytes = { 255, 255, 255, 255 };
    if (tuple < mapped.Colors->GetNumberOfTuples())
    {
      mapped.Colors->GetTypedTuple(tuple, bytes.data());
    }
    return bytes;
  };
  surface.colorsOfTriangles = mapped.OfCells;
  if (surface.colorsOfTriangles)
  {
    for (const vtkIdType cell : triangulation.Cells)
    {
      surface.colors.push_back(colorAt(cell));
    }
    return;
  }
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
  {
    surface.colors.push_back(colorAt(static_cast<vtkIdType>(i)));
  }
}

std::shared_ptr<raytracing::Surface> surfaceOf(
  vtkActor* actor, const vtkIsopointTracedBlock& block, const Placement& placement)
{
  const auto surface = std::make_shared<raytracing::Surface>();
  Triangulation triangulation(block.Data);
  if (triangulation.Triangles.empty())
  {
    return nullptr;
  }
  const vtkIdType count = block.Data->GetNumberOfPoints();
  if (count - 1 > static_cast<vtkIdType>(std::numeric_limits<std::uint32_t>::max()))
  {
    throw std::runtime_error("a block has more points than Embree can number. Split it.");
  }
  vtkDataArray* normals = block.Data->GetPointData()->GetNormals();
  const bool isFlat = actor->GetProperty()->GetInterpolation() == VTK_FLAT;
  if (isFlat || (normals && normals->GetNumberOfTuples() < count))
  {
    normals = nullptr;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    double values[3];
    block.Data->GetPoint(i, values);
    surface->vertices.push_back(placement.Point(values));
    if (normals)
    {
      normals->GetTuple(i, values);
      surface->normals.push_back(placement.Normal(values));
    }
  }
  surface->color = vtkToTracedVector(
    block.HasColor ? block.Color.data() : actor->GetProperty()->GetDiffuseColor());
  const MappedColors mapped =
    block.HasColor ? MappedColors() : mappedColors(actor->GetMapper(), block.Data);
  if (mapped.Colors)
  {
    setColors(*surface, triangulation, mapped);
  }
  surface->triangles = std::move(triangulation.Triangles);
  surface->outward = raytracing::orientationOf(*surface);
  return surface;
}

} // namespace

std::vector<std::shared_ptr<raytracing::Surface>> vtkMakeTracedSurfaces(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame)
{
  std::vector<std::shared_ptr<raytracing::Surface>> surfaces;
  const Placement placement(actor->GetMatrix(), frame);
  if (placement.GetIsSingular())
  {
    return surfaces;
  }
  for (const vtkIsopointTracedBlock& block : vtkGetTracedBlocks(actor->GetMapper()))
  {
    const auto surface = block.Visible ? surfaceOf(actor, block, placement) : nullptr;
    if (surface)
    {
      surface->material = materialOf(actor, absorptionDistance, frame);
      surfaces.push_back(surface);
    }
  }
  return surfaces;
}
