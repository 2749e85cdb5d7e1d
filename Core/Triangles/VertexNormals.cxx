// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/VertexNormals.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isopoint
{
namespace
{

bool hasDirection(const Vector& vector)
{
  const double length = lengthOf(vector);
  return std::isfinite(length) && length > 0.0;
}

/// The area-weighted sum of triangle normals at each vertex, in any unit.
std::vector<Vector> triangleNormals(const Execution& execution,
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles)
{
  std::vector<Vector> sums(positions.size());
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      const Vector normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
      for (const std::size_t vertex : { a, b, c })
      {
        sums[vertex] += normal;
      }
    });
  return sums;
}

/// For each vertex, the sum of the values at the other corners of its triangles.
std::vector<Vector> sumsAround(const Execution& execution, const std::vector<Vector>& all,
  const std::vector<SurfaceTriangle>& triangles)
{
  std::vector<Vector> sums(all.size());
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      sums[a] += all[b] + all[c];
      sums[b] += all[c] + all[a];
      sums[c] += all[a] + all[b];
    });
  return sums;
}

/// Vertices with wrong fits: their normals disagree with both the triangles around and the
/// triangles around their neighbors. (Thin triangles around one vertex can have any normal.)
/// @param normals of vertices, except for `others`
/// @param ofTriangles triangleNormals()
std::vector<std::size_t> failedNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<Vector>& normals,
  const std::vector<std::size_t>& others, const std::vector<Vector>& ofTriangles)
{
  constexpr double minCosine = 0.5; // of 60 degrees
  const auto isTurnedFrom = [&](const std::vector<Vector>& means, std::size_t vertex)
  {
    return hasDirection(means[vertex]) &&
           dot(normals[vertex], directionOf(means[vertex])) < minCosine;
  };
  std::vector<char> isOther(normals.size(), 0);
  forEachIndex(execution, others.size(), [&](std::size_t i) { isOther[others[i]] = 1; });
  std::vector<std::size_t> failed = itemsThat(execution, normals.size(),
    [&](std::size_t vertex)
    {
      return !isOther[vertex] && points.fits[vertex].order != FitOrder::Crease &&
             isTurnedFrom(ofTriangles, vertex);
    });
  if (!failed.empty())
  {
    const std::vector<Vector> around = sumsAround(execution, ofTriangles, triangles);
    failed.erase(std::remove_if(failed.begin(), failed.end(),
                   [&](std::size_t vertex) { return !isTurnedFrom(around, vertex); }),
      failed.end());
  }
  return failed;
}

} // namespace

std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField)
{
  std::vector<Vector> normals(points.positions.size());
  std::vector<std::size_t> others = setFieldNormals(execution, points, areOfField,
    [&normals](std::size_t vertex, const Vector& normal) { normals[vertex] = normal; });
  const std::vector<Vector> ofTriangles = triangleNormals(execution, points.positions, triangles);
  if (others.size() < normals.size())
  {
    const std::vector<std::size_t> failed =
      failedNormals(execution, points, triangles, normals, others, ofTriangles);
    others.insert(others.end(), failed.begin(), failed.end());
  }
  forEachIndex(execution, others.size(),
    [&](std::size_t i)
    {
      const std::size_t vertex = others[i];
      const Vector& normal = ofTriangles[vertex];
      normals[vertex] = directionOf(hasDirection(normal) ? normal : points.decreasingEdges[vertex]);
    });
  return normals;
}

} // namespace isopoint
