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

/// Vertices with wrong fits: their normals disagree with both the triangles around and the
/// triangles around their neighbors. (Thin triangles around one vertex can have any normal.)
/// @param normals of vertices, except for `others`
/// @param ofTriangles areaNormals()
std::vector<std::size_t> failedNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing,
  const std::vector<Vector>& normals, const std::vector<std::size_t>& others,
  const std::vector<Vector>& ofTriangles)
{
  constexpr double minCosine = 0.5; // of 60 degrees
  const auto isTurnedFrom = [&](const Vector& mean, std::size_t vertex)
  { return hasDirection(mean) && dot(normals[vertex], directionOf(mean)) < minCosine; };
  const auto sumAround = [&](std::size_t vertex)
  {
    Vector sum{};
    outgoing.forEachAt(vertex,
      [&](HalfEdge side)
      {
        const SurfaceTriangle& corners = triangles[side / 3];
        sum += ofTriangles[corners[nextOf(side) % 3]] + ofTriangles[corners[lastOf(side) % 3]];
      });
    return sum;
  };
  std::vector<char> isOther(normals.size(), 0);
  forEachIndex(execution, others.size(), [&](std::size_t i) { isOther[others[i]] = 1; });
  return itemsThat(execution, normals.size(),
    [&](std::size_t vertex)
    {
      return !isOther[vertex] && points.fits[vertex].order != FitOrder::Crease &&
             isTurnedFrom(ofTriangles[vertex], vertex) && isTurnedFrom(sumAround(vertex), vertex);
    });
}

} // namespace

std::vector<Vector> areaNormals(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing)
{
  std::vector<Vector> sums(positions.size());
  forEachIndex(execution, sums.size(),
    [&](std::size_t vertex)
    {
      outgoing.forEachAt(vertex,
        [&](HalfEdge side)
        {
          const auto& [a, b, c] = triangles[side / 3];
          sums[vertex] += cross(positions[b] - positions[a], positions[c] - positions[a]);
        });
    });
  return sums;
}

std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField)
{
  std::vector<Vector> normals(points.positions.size());
  std::vector<std::size_t> others = setFieldNormals(execution, points, areOfField,
    [&normals](std::size_t vertex, const Vector& normal) { normals[vertex] = normal; });
  const OutgoingHalfEdges outgoing(execution, triangles, points.positions.size());
  const std::vector<Vector> ofTriangles =
    areaNormals(execution, points.positions, triangles, outgoing);
  if (others.size() < normals.size())
  {
    const std::vector<std::size_t> failed =
      failedNormals(execution, points, triangles, outgoing, normals, others, ofTriangles);
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
