// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatShapes.h"

#include "vtkIsopointVertexCells.h"

#include "Common/vtkIsopointArrays.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <cstddef>

namespace
{

using isopoint::operator+;
using isopoint::operator+=;
using isopoint::operator-;
using isopoint::operator*;
using isopoint::SplatFan;
using isopoint::Vector;

Vector tupleOf(vtkDataArray* array, vtkIdType tuple)
{
  Vector vector;
  array->GetTuple(tuple, vector.data());
  return vector;
}

SplatFan movedTo(const Vector& position, SplatFan fan)
{
  for (std::size_t i = 0; i < fan.vertexCount; ++i)
  {
    fan.positions[i] += position;
  }
  return fan;
}

SplatFan octagonOf(const Vector& position, const Vector& normal, double radius)
{
  Vector along;
  Vector across;
  vtkMath::Perpendiculars(normal.data(), along.data(), across.data(), 0.0);
  if (isopoint::dot(isopoint::cross(normal, along), across) < 0.0)
  {
    across = -across;
  }
  constexpr std::size_t corners = 8;
  SplatFan fan;
  fan.vertexCount = 1 + corners;
  fan.normals.fill(normal);
  fan.positions[0] = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / corners;
    fan.positions[1 + i] = radius * std::cos(angle) * along + radius * std::sin(angle) * across;
  }
  isopoint::makeTriangles(fan, /*isClosed=*/true);
  return movedTo(position, fan);
}

SplatFan octahedronOf(const Vector& position, double radius)
{
  SplatFan fan;
  fan.vertexCount = 6;
  fan.triangleCount = 8;
  fan.normals = { { { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { -1.0, 0.0, 0.0 },
    { 0.0, -1.0, 0.0 }, { 0.0, 0.0, -1.0 } } };
  for (std::size_t i = 0; i < fan.vertexCount; ++i)
  {
    fan.positions[i] = radius * fan.normals[i];
  }
  for (std::size_t i = 0; i < 4; ++i) // around the upper and the lower tip
  {
    const std::size_t next = (i + 1) % 4;
    fan.triangles[i] = { 0, 1 + i, 1 + next };
    fan.triangles[4 + i] = { 5, 1 + next, 1 + i };
  }
  return movedTo(position, fan);
}

double automaticRadius(vtkDataSet* data)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Vector position;
    data->GetPoint(i, position.data());
    if (isopoint::isFinite(position))
    {
      box.AddPoint(position.data());
    }
  }
  const double diagonal = box.IsValid() ? box.GetDiagonalLength() : 0.0;
  const double radius = 2.0 * diagonal / std::sqrt(static_cast<double>(data->GetNumberOfPoints()));
  return std::isfinite(radius) && radius > 0.0 ? radius : 1.0;
}

} // namespace

vtkIsopointSplatShapes::vtkIsopointSplatShapes(vtkDataSet* data,
  const vtkIsopointVertexCells& cells, const char* radiusArrayName, double radius, double scale)
  : Data(data)
  , Cells(cells)
  , Shapes(data->GetCellData())
  , Radius(radius)
  , Scale(scale)
  , PositionError(isopoint::positionErrorOf(vtkGetTypeOfPoints(data) == VTK_FLOAT))
{
  vtkPointData* const arrays = data->GetPointData();
  const vtkIdType count = data->GetNumberOfPoints();
  this->Normals = this->Usable(arrays->GetNormals(), 3, count);
  this->Radii = this->Usable(
    radiusArrayName && radiusArrayName[0] ? arrays->GetArray(radiusArrayName) : nullptr, 1, count);
  vtkIdType tuples = data->GetNumberOfCells();
  if (!this->Shapes->HasArray(vtkSplatPolygonArrayName)) // files may have it as a point array
  {
    this->Shapes = arrays;
    tuples = count;
  }
  this->Axes = this->Usable(this->Shapes->GetArray(vtkSplatAxisArrayName), 3, tuples);
  this->Polygons = this->Usable(this->Shapes->GetArray(vtkSplatPolygonArrayName),
    static_cast<int>(isopoint::numbersOfSplat), tuples);
  this->Ghosts = data->GetPointGhostArray();
  if (!this->Radii && !(radius > 0.0))
  {
    this->Radius = automaticRadius(data);
    this->IsRadiusDerived = true;
  }
}

vtkDataArray* vtkIsopointSplatShapes::Usable(vtkDataArray* array, int components, vtkIdType tuples)
{
  return array && array->GetNumberOfComponents() == components &&
             array->GetNumberOfTuples() >= tuples
           ? array
           : nullptr;
}

std::string vtkIsopointSplatShapes::Problem() const
{
  if (this->Shapes->HasArray(vtkSplatPolygonArrayName) && !this->Polygons)
  {
    return "The array \"SplatPolygon\" has not 40 components for each vertex cell: splats are "
           "octagons of the points' radii. Keep the array as it was extracted.";
  }
  if (this->Polygons && !this->Axes)
  {
    return "The array \"SplatPolygon\" has no array \"SplatAxis\" of three components beside "
           "it: splats are octagons of the points' radii. Pass both arrays.";
  }
  if (this->Polygons && !this->Normals)
  {
    return "The points have splats but no active normals: octahedra are drawn. Make the array "
           "\"Normals\" the active normals.";
  }
  if (!this->Normals && this->IsRadiusDerived)
  {
    return "The points have neither normals nor radii: octahedra of one size are drawn. Pass the "
           "output of vtkScatteredIsopointFilter (Scattered Isopoints).";
  }
  return "";
}

bool vtkIsopointSplatShapes::IsGhost(vtkIdType point) const
{
  constexpr int hidden = vtkDataSetAttributes::HIDDENPOINT | vtkDataSetAttributes::DUPLICATEPOINT;
  return this->Ghosts && (this->Ghosts->GetValue(point) & hidden) != 0;
}

SplatFan vtkIsopointSplatShapes::Fan(vtkIdType point) const
{
  Vector position;
  this->Data->GetPoint(point, position.data());
  if (this->IsGhost(point) || !isopoint::isFinite(position))
  {
    return {};
  }
  const Vector normal =
    this->Normals ? isopoint::unitNormal(tupleOf(this->Normals, point)) : Vector{ 0.0, 0.0, 0.0 };
  const bool hasNormal = isopoint::dot(normal, normal) > 0.5;
  const vtkIdType polygon = hasNormal ? this->PolygonOf(point, normal) : -1;
  if (polygon >= 0)
  {
    isopoint::SplatNumbers numbers;
    this->Polygons->GetTuple(polygon, numbers.data());
    return isopoint::fanOf(
      position, normal, tupleOf(this->Axes, polygon), numbers, this->Scale, this->PositionError);
  }
  const double radius =
    this->Scale * (this->Radii ? this->Radii->GetComponent(point, 0) : this->Radius);
  if (!(radius > 0.0) || !std::isfinite(radius))
  {
    return {};
  }
  return hasNormal ? octagonOf(position, normal, radius) : octahedronOf(position, radius);
}

vtkIdType vtkIsopointSplatShapes::PolygonOf(vtkIdType point, const Vector& normal) const
{
  if (!this->Axes || !this->Polygons)
  {
    return -1;
  }
  const bool areOfCells = this->Shapes == this->Data->GetCellData();
  const vtkIdType tuple = areOfCells ? this->Cells.Single(point) : point;
  if (tuple < 0)
  {
    return -1;
  }
  // A filter may have rotated only the normals.
  constexpr double steepest = 1e-4;
  const Vector axis = tupleOf(this->Axes, tuple);
  const double length = std::sqrt(isopoint::dot(axis, axis));
  return std::abs(isopoint::dot(axis, normal)) > steepest * length ? -1 : tuple;
}
