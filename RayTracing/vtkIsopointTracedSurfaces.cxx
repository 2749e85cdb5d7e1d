// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedActor.h"

#include "vtkIsopointTracedBlocks.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkProperty.h"
#include "vtkTriangleStrip.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace
{

/// The cells of a polydata as triangles, and the cell that each of them is of.
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
      double position[3];
      this->Data->GetPoint(corner, position);
      if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2]))
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

void setColors(raytracing::Surface& surface, const Triangulation& triangulation,
  vtkUnsignedCharArray* colors, int cellFlag)
{
  const auto colorAt = [colors](vtkIdType tuple)
  {
    raytracing::ColorBytes bytes = { 255, 255, 255, 255 };
    if (tuple < colors->GetNumberOfTuples())
    {
      colors->GetTypedTuple(tuple, bytes.data());
    }
    return bytes;
  };
  surface.colorsOfTriangles = cellFlag == 1;
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
  vtkActor* actor, const vtkIsopointTracedBlock& block, const vtkIsopointTracedPlacement& placement)
{
  const auto surface = std::make_shared<raytracing::Surface>();
  Triangulation triangulation(block.Data);
  if (triangulation.Triangles.empty())
  {
    return nullptr;
  }
  const vtkIdType count = block.Data->GetNumberOfPoints();
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
    const std::array<double, 3> place = placement.Point(values);
    surface->vertices.push_back(vtkIsopointTracedVector(place.data()));
    if (normals)
    {
      normals->GetTuple(i, values);
      const std::array<double, 3> normal = placement.Normal(values);
      surface->normals.push_back(
        raytracing::directionOf(vtkIsopointTracedVector(normal.data()), { 0.0f, 0.0f, 0.0f }));
    }
  }
  surface->color = vtkIsopointTracedColor(actor, block);
  int cellFlag = 0;
  if (!block.HasColor)
  {
    if (const auto colors = vtkIsopointTracedColors(actor->GetMapper(), block.Data, cellFlag))
    {
      setColors(*surface, triangulation, colors, cellFlag);
    }
  }
  surface->triangles = std::move(triangulation.Triangles);
  surface->outward = raytracing::orientationOf(*surface);
  return surface;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<std::shared_ptr<raytracing::Surface>> vtkIsopointTracedSurfaces(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame)
{
  std::vector<std::shared_ptr<raytracing::Surface>> surfaces;
  const vtkIsopointTracedPlacement placement(actor->GetMatrix(), frame);
  if (placement.GetIsSingular())
  {
    return surfaces;
  }
  for (const vtkIsopointTracedBlock& block : vtkIsopointTracedBlocks(actor->GetMapper()))
  {
    const auto surface = block.Visible ? surfaceOf(actor, block, placement) : nullptr;
    if (surface)
    {
      surface->material = vtkIsopointTracedMaterial(actor, absorptionDistance, frame);
      surfaces.push_back(surface);
    }
  }
  return surfaces;
}
