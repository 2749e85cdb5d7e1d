// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatShapes.h"

#include "vtkIsopointVertexCells.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr int mostCorners = 8;
constexpr int numbersOfCorner = 5;
constexpr int numbersOfPolygon = mostCorners * numbersOfCorner;

bool isFinite(const vtkVector3d& vector)
{
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

vtkVector3d tupleOf(vtkDataArray* array, vtkIdType tuple)
{
  vtkVector3d vector;
  array->GetTuple(tuple, vector.GetData());
  return vector;
}

/// Makes a fan around its point one around its first corner.
void dropPoint(vtkIsopointSplatFan& fan)
{
  std::copy(fan.Places.begin() + 1, fan.Places.end(), fan.Places.begin());
  std::copy(fan.Normals.begin() + 1, fan.Normals.end(), fan.Normals.begin());
  --fan.Vertices;
  fan.Triangles -= 2;
}

double automaticRadius(vtkDataSet* data)
{
  vtkBoundingBox box;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    vtkVector3d position;
    data->GetPoint(i, position.GetData());
    if (isFinite(position))
    {
      box.AddPoint(position.GetData());
    }
  }
  const double diagonal = box.IsValid() ? box.GetDiagonalLength() : 0.0;
  const double radius = 2.0 * diagonal / std::sqrt(static_cast<double>(data->GetNumberOfPoints()));
  return std::isfinite(radius) && radius > 0.0 ? radius : 1.0;
}

} // namespace

//------------------------------------------------------------------------------
int vtkIsopointSplatCorner(const vtkIsopointSplatFan& fan, int triangle, int corner)
{
  if (fan.Triangles == fan.Vertices - 1) // around the point
  {
    return corner == 0 ? 0 : 1 + (triangle + corner - 1) % fan.Triangles;
  }
  if (fan.Triangles == fan.Vertices - 2) // around the first corner
  {
    return corner == 0 ? 0 : triangle + corner;
  }
  // An octahedron: four triangles around the upper tip, vertex 0, and four around the lower one.
  const bool isUpper = triangle < 4;
  if (corner == 0)
  {
    return isUpper ? 0 : 5;
  }
  return 1 + (triangle + (isUpper ? corner - 1 : 2 - corner)) % 4;
}

//------------------------------------------------------------------------------
vtkIsopointSplatShapes::vtkIsopointSplatShapes(vtkDataSet* data,
  const vtkIsopointVertexCells& cells, const char* radiusArrayName, double radius, double scale)
  : Data(data)
  , Cells(cells)
  , Shapes(data->GetCellData())
  , Radius(radius)
  , Scale(scale)
{
  vtkPointData* const arrays = data->GetPointData();
  const vtkIdType count = data->GetNumberOfPoints();
  this->Normals = this->Usable(arrays->GetNormals(), 3, count);
  this->Radii = this->Usable(
    radiusArrayName && radiusArrayName[0] ? arrays->GetArray(radiusArrayName) : nullptr, 1, count);
  vtkIdType tuples = data->GetNumberOfCells();
  if (!this->Shapes->HasArray("SplatPolygon")) // files may have them at the points
  {
    this->Shapes = arrays;
    tuples = count;
  }
  this->Axes = this->Usable(this->Shapes->GetArray("SplatAxis"), 3, tuples);
  this->Polygons = this->Usable(this->Shapes->GetArray("SplatPolygon"), numbersOfPolygon, tuples);
  this->Ghosts = data->GetPointGhostArray();
  const auto points = vtkPointSet::SafeDownCast(data);
  const bool isFloat =
    points && points->GetPoints() && points->GetPoints()->GetDataType() == VTK_FLOAT;
  this->PositionError = 2.0 * (isFloat ? std::numeric_limits<float>::epsilon()
                                       : std::numeric_limits<double>::epsilon());
  if (!this->Radii && !(radius > 0.0))
  {
    this->Radius = automaticRadius(data);
  }
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsopointSplatShapes::Usable(vtkDataArray* array, int components, vtkIdType tuples)
{
  return array && array->GetNumberOfComponents() == components &&
             array->GetNumberOfTuples() >= tuples
           ? array
           : nullptr;
}

//------------------------------------------------------------------------------
std::string vtkIsopointSplatShapes::Problem() const
{
  if (this->Shapes->HasArray("SplatPolygon") && !this->Polygons)
  {
    return "The array \"SplatPolygon\" has not 40 components for each vertex cell: splats are "
           "octagons of the points' radii. Use the array as vtkScatteredIsopointFilter writes it.";
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
  return "";
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatShapes::IsGhost(vtkIdType point) const
{
  constexpr int hidden = vtkDataSetAttributes::HIDDENPOINT | vtkDataSetAttributes::DUPLICATEPOINT;
  return this->Ghosts && (this->Ghosts->GetValue(point) & hidden) != 0;
}

//------------------------------------------------------------------------------
vtkIsopointSplatFan vtkIsopointSplatShapes::Fan(vtkIdType point) const
{
  vtkIsopointSplatFan fan;
  vtkVector3d position;
  this->Data->GetPoint(point, position.GetData());
  if (this->IsGhost(point) || !isFinite(position))
  {
    return fan;
  }
  vtkVector3d normal(0.0, 0.0, 0.0);
  if (this->Normals)
  {
    normal = tupleOf(this->Normals, point);
    normal.Normalize();
  }
  const bool hasNormal = normal.SquaredNorm() > 0.5;
  const vtkIdType polygon = hasNormal ? this->PolygonOf(point, normal) : -1;
  if (polygon >= 0)
  {
    if (!this->SetPolygon(polygon, normal, fan))
    {
      return {};
    }
    const double largest =
      std::max({ std::abs(position[0]), std::abs(position[1]), std::abs(position[2]) });
    fan.Tolerance += static_cast<float>(this->PositionError * largest);
  }
  else
  {
    const double radius =
      this->Scale * (this->Radii ? this->Radii->GetComponent(point, 0) : this->Radius);
    if (!(radius > 0.0) || !std::isfinite(radius))
    {
      return fan;
    }
    if (hasNormal)
    {
      this->SetOctagon(normal, radius, fan);
    }
    else
    {
      this->SetOctahedron(radius, fan);
    }
  }
  for (int i = 0; i < fan.Vertices; ++i)
  {
    auto& place = fan.Places[static_cast<std::size_t>(i)];
    place = place + position;
  }
  return fan;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsopointSplatShapes::PolygonOf(vtkIdType point, const vtkVector3d& normal) const
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
  // A filter may have turned the normals alone.
  constexpr double steepest = 1e-4;
  const vtkVector3d axis = tupleOf(this->Axes, tuple);
  return std::abs(axis.Dot(normal)) > steepest * axis.Norm() ? -1 : tuple;
}

//------------------------------------------------------------------------------
bool vtkIsopointSplatShapes::SetPolygon(
  vtkIdType tuple, const vtkVector3d& normal, vtkIsopointSplatFan& fan) const
{
  std::array<double, numbersOfPolygon> numbers;
  this->Polygons->GetTuple(tuple, numbers.data());
  const vtkVector3d along = tupleOf(this->Axes, tuple);
  const vtkVector3d across = normal.Cross(along);
  const double radius = along.Norm();
  if (!(radius > 0.0) || !std::isfinite(radius))
  {
    return false;
  }
  double steepest = 0.0;
  fan.Places[0] = vtkVector3d(0.0, 0.0, 0.0);
  fan.Normals[0] = normal;
  fan.Vertices = 1;
  for (int i = 0; i < mostCorners; ++i)
  {
    const double* const corner = numbers.data() + numbersOfCorner * i;
    const auto next = static_cast<std::size_t>(fan.Vertices);
    const vtkVector3d place = (corner[0] * this->Scale) * along +
                              (corner[1] * this->Scale) * across +
                              (corner[2] * this->Scale * this->Scale * radius) * normal;
    if (!isFinite(place))
    {
      return false;
    }
    if (next > 1 && place == fan.Places[next - 1])
    {
      continue; // fewer corners repeat the last one
    }
    steepest = std::max({ steepest, std::hypot(corner[3], corner[4]), std::abs(corner[2]) });
    fan.Places[next] = place;
    fan.Normals[next] = normal + (this->Scale * corner[3] / radius) * along +
                        (this->Scale * corner[4] / radius) * across;
    fan.Normals[next].Normalize();
    ++fan.Vertices;
  }
  fan.Triangles = fan.Vertices - 1;
  if (fan.Triangles < 3)
  {
    return false;
  }
  // Corners are sums of a few numbers of float.
  fan.Tolerance = static_cast<float>(16.0 * std::numeric_limits<float>::epsilon() * radius);
  // Around the point of such a fan the surface is flat to a hundredth of the splat's size. Without
  // a vertex there it looks the same, with a third fewer triangles.
  constexpr double slightSlope = 0.03;
  if (this->Scale * steepest < slightSlope)
  {
    dropPoint(fan);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatShapes::SetOctagon(
  const vtkVector3d& normal, double radius, vtkIsopointSplatFan& fan) const
{
  vtkVector3d along;
  vtkVector3d across;
  vtkMath::Perpendiculars(normal.GetData(), along.GetData(), across.GetData(), 0.0);
  if (normal.Cross(along).Dot(across) < 0.0)
  {
    across = -1.0 * across;
  }
  fan.Vertices = 1 + mostCorners;
  fan.Triangles = mostCorners;
  fan.Normals.fill(normal);
  fan.Places[0] = vtkVector3d(0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < mostCorners; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / mostCorners;
    fan.Places[1 + i] = (radius * std::cos(angle)) * along + (radius * std::sin(angle)) * across;
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatShapes::SetOctahedron(double radius, vtkIsopointSplatFan& fan) const
{
  fan.Vertices = 6;
  fan.Triangles = 8;
  fan.Normals = { vtkVector3d(0.0, 0.0, 1.0), vtkVector3d(1.0, 0.0, 0.0),
    vtkVector3d(0.0, 1.0, 0.0), vtkVector3d(-1.0, 0.0, 0.0), vtkVector3d(0.0, -1.0, 0.0),
    vtkVector3d(0.0, 0.0, -1.0) };
  for (std::size_t i = 0; i < 6; ++i)
  {
    fan.Places[i] = radius * fan.Normals[i];
  }
}
