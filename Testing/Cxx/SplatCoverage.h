// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "FilterTesting.h"

#include <cstdint>
#include <map>
#include <unordered_map>

namespace splatcoverage
{

using namespace filtertesting;
using analytic::cross;

/// A fan of triangles in space: between its center and each two consecutive corners.
struct Splat
{
  Vector center;
  Vector normal;               // of length 1
  std::vector<Vector> corners; // counterclockwise seen from the tip of the normal

  /// The distance of the farthest corner.
  double radius() const
  {
    double farthest = 0.0;
    for (const Vector& corner : this->corners)
    {
      farthest = std::max(farthest, length(corner - this->center));
    }
    return farthest;
  }
};

/// The corners that a tuple of "SplatPolygon" describes.
inline std::vector<Vector> cornersOf(const Vector& center, const Vector& normal, const Vector& axis,
  vtkDataArray* polygons, vtkIdType i)
{
  const Vector across = cross(normal, axis);
  const double radius = length(axis);
  std::vector<Vector> corners;
  for (int k = 0; k < polygons->GetNumberOfComponents(); k += 5)
  {
    const auto number = [&](int j) { return polygons->GetComponent(i, k + j); };
    const Vector inPlane = number(0) * axis + number(1) * across;
    const Vector corner = center + (inPlane + radius * number(2) * normal);
    if (corners.empty() || corner != corners.back())
    {
      corners.push_back(corner);
    }
  }
  return corners;
}

/// The cell of a grid where a place is, or one a few cells away.
inline std::uint64_t keyOf(
  const Vector& place, double cellSize, const std::array<int, 3>& away = {})
{
  std::uint64_t key = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto cell = std::llround(std::floor(place[axis] / cellSize)) + away[axis];
    key = (key << 21) | static_cast<std::uint64_t>(cell + (1 << 20));
  }
  return key;
}

/// The splats of a point cloud with normals and the cell arrays "SplatAxis" and "SplatPolygon" of
/// its vertices, in the order of the points; none without them.
inline std::vector<Splat> splatsOf(vtkPolyData* points)
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

/// Determines whether splats cover places.
class Coverage
{
public:
  /// @param minTolerance a splat covers places up to this distance from its plane, or up to half
  /// its radius if that is more
  Coverage(const std::vector<Splat>& splats, double minTolerance)
    : Splats(splats)
    , LeastTolerance(minTolerance)
  {
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      const double reach = std::max(2.0 * splats[i].radius(), minTolerance);
      const double cellSize = std::exp2(std::ceil(std::log2(reach)));
      this->Levels[cellSize][keyOf(splats[i].center, cellSize)].push_back(i);
    }
  }

  /// Complexity: linear in the number of splats around the place.
  /// @param normal of the surface there: the place is seen along it
  bool covers(const Vector& place, const Vector& normal) const
  {
    for (const auto& [cellSize, cells] : this->Levels)
    {
      for (int i = 0; i < 27; ++i)
      {
        const auto found =
          cells.find(keyOf(place, cellSize, { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 }));
        if (found != cells.end() &&
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

private:
  bool isCoveredBy(const Splat& splat, const Vector& place, const Vector& normal) const
  {
    const Vector center = splat.center - place;
    const double radius = splat.radius();
    if (std::abs(dot(center, splat.normal)) > std::max(this->LeastTolerance, 0.5 * radius))
    {
      return false;
    }
    const double tolerance = 1e-6 * radius * radius; // corners are rounded
    for (std::size_t i = 0; i < splat.corners.size(); ++i)
    {
      const Vector a = splat.corners[i] - place;
      const Vector b = splat.corners[(i + 1) % splat.corners.size()] - place;
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

  const std::vector<Splat>& Splats;
  double LeastTolerance;
  /// Splats of similar size, by the cell of their center, in grids whose cells have this size: at
  /// least the distance up to which these splats cover places.
  std::map<double, std::unordered_map<std::uint64_t, std::vector<std::size_t>>> Levels;
};

} // namespace splatcoverage
