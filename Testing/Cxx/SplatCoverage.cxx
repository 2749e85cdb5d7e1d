// SPDX-License-Identifier: GPL-3.0-or-later
#include "SplatCoverage.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace splatcoverage
{
namespace
{

using analytic::cross;
using analytic::difference;
using analytic::dot;
using analytic::length;
using analytic::Vector;

/// An array's tuple of three components.
Vector tupleOf(vtkDataArray* array, vtkIdType i)
{
  return { array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2) };
}

/// The corners that a tuple of "SplatPolygon" describes.
std::vector<Vector> cornersOf(const Vector& center, const Vector& normal, const Vector& axis,
  vtkDataArray* polygons, vtkIdType i)
{
  const Vector across = cross(normal, axis);
  const double radius = length(axis);
  std::vector<Vector> corners;
  for (int k = 0; k < polygons->GetNumberOfComponents(); k += 5)
  {
    const auto number = [&](int j) { return polygons->GetComponent(i, k + j); };
    const Vector inPlane =
      analytic::sum(analytic::scaled(axis, number(0)), analytic::scaled(across, number(1)));
    const Vector corner =
      analytic::sum(center, analytic::sum(inPlane, analytic::scaled(normal, radius * number(2))));
    if (corners.empty() || corner != corners.back())
    {
      corners.push_back(corner);
    }
  }
  return corners;
}

std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z)
{
  constexpr std::int64_t half = 1 << 20;
  return (static_cast<std::uint64_t>(x + half) << 42) |
         (static_cast<std::uint64_t>(y + half) << 21) | static_cast<std::uint64_t>(z + half);
}

} // namespace

double Splat::radius() const
{
  double farthest = 0.0;
  for (const Vector& corner : this->corners)
  {
    farthest = std::max(farthest, length(difference(corner, this->center)));
  }
  return farthest;
}

std::vector<Splat> splatsOf(vtkPolyData* points)
{
  vtkCellData* const data = points->GetCellData();
  vtkDataArray* const normals = points->GetPointData()->GetNormals();
  vtkDataArray* const axes = data->GetArray("SplatAxis");
  vtkDataArray* const polygons = data->GetArray("SplatPolygon");
  std::vector<Splat> splats;
  if (!normals || !axes || !polygons)
  {
    return splats;
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Splat splat;
    points->GetPoint(i, splat.center.data());
    splat.normal = tupleOf(normals, i);
    splat.corners = cornersOf(splat.center, splat.normal, tupleOf(axes, i), polygons, i);
    splats.push_back(splat);
  }
  return splats;
}

Coverage::Coverage(const std::vector<Splat>& splats, double leastTolerance)
  : Splats(splats)
  , LeastTolerance(leastTolerance)
{
  std::map<int, std::vector<std::size_t>> byOctave;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const double reach = std::max(2.0 * splats[i].radius(), leastTolerance);
    byOctave[static_cast<int>(std::ceil(std::log2(reach)))].push_back(i);
  }
  for (const auto& [octave, indices] : byOctave)
  {
    Level level;
    level.cellSize = std::exp2(octave);
    for (const std::size_t i : indices)
    {
      const Vector& c = splats[i].center;
      level
        .cells[keyOf(std::llround(std::floor(c[0] / level.cellSize)),
          std::llround(std::floor(c[1] / level.cellSize)),
          std::llround(std::floor(c[2] / level.cellSize)))]
        .push_back(i);
    }
    this->Levels.push_back(std::move(level));
  }
}

bool Coverage::isCoveredBy(const Splat& splat, const Vector& place, const Vector& normal) const
{
  const Vector center = difference(splat.center, place);
  const double radius = splat.radius();
  if (std::abs(dot(center, splat.normal)) > std::max(this->LeastTolerance, 0.5 * radius))
  {
    return false;
  }
  const double tolerance = 1e-6 * radius * radius; // corners are rounded
  for (std::size_t i = 0; i < splat.corners.size(); ++i)
  {
    const Vector a = difference(splat.corners[i], place);
    const Vector b = difference(splat.corners[(i + 1) % splat.corners.size()], place);
    const std::array<double, 3> sides{ dot(cross(center, a), normal), dot(cross(a, b), normal),
      dot(cross(b, center), normal) };
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    if ((*least >= -tolerance || *most <= tolerance) && *most - *least > tolerance)
    {
      return true;
    }
  }
  return false;
}

bool Coverage::covers(const Vector& place, const Vector& normal) const
{
  for (const Level& level : this->Levels)
  {
    std::array<std::int64_t, 3> lowest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lowest[axis] = std::llround(std::floor(place[axis] / level.cellSize)) - 1;
    }
    for (int i = 0; i < 27; ++i)
    {
      const auto found =
        level.cells.find(keyOf(lowest[0] + i % 3, lowest[1] + i / 3 % 3, lowest[2] + i / 9));
      if (found != level.cells.end() &&
          std::any_of(found->second.begin(), found->second.end(),
            [&](std::size_t splat)
            { return this->isCoveredBy(this->Splats[splat], place, normal); }))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace splatcoverage
