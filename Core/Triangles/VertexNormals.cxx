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
  const auto disagrees = [&](const Vector& mean, std::size_t vertex)
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
             disagrees(ofTriangles[vertex], vertex) && disagrees(sumAround(vertex), vertex);
    });
}

/// The angle of a cosine in radians, to 1e-4: by polynomials, as C libraries differ
/// ([AS64], 4.4.45).
double angleOf(double cosine)
{
  constexpr double pi = 3.14159265358979;
  const double x = std::min(std::abs(cosine), 1.0);
  const double angle =
    std::sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
  return cosine < 0.0 ? pi - angle : angle;
}

/// The sum of the normals of the triangles at a vertex, weighted by their angles there.
Vector angleNormal(const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing,
  std::size_t vertex)
{
  Vector sum{};
  outgoing.forEachAt(vertex,
    [&](HalfEdge side)
    {
      const SurfaceTriangle& corners = triangles[side / 3];
      const Vector next = positions[corners[nextOf(side) % 3]] - positions[vertex];
      const Vector last = positions[corners[lastOf(side) % 3]] - positions[vertex];
      const Vector normal = cross(next, last);
      if (hasDirection(normal))
      {
        sum += angleOf(dot(directionOf(next), directionOf(last))) * directionOf(normal);
      }
    });
  return sum;
}

/// The least cosine between a normal of a vertex and those of the triangles there.
double leastCosine(const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing,
  std::size_t vertex, const Vector& normal)
{
  double least = 1.0;
  outgoing.forEachAt(vertex,
    [&](HalfEdge side)
    {
      const Vector ofTriangle = areaNormal(positions, triangles[side / 3]);
      if (hasDirection(ofTriangle))
      {
        least = std::min(least, dot(normal, directionOf(ofTriangle)));
      }
    });
  return least;
}

} // namespace

std::vector<Vector> areaNormals(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing)
{
  return tabulated<Vector>(execution, positions.size(),
    [&](std::size_t vertex)
    {
      Vector sum{};
      outgoing.forEachAt(
        vertex, [&](HalfEdge side) { sum += areaNormal(positions, triangles[side / 3]); });
      return sum;
    });
}

std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField, bool isClosed)
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
  if (isClosed)
  {
    forEachIndex(execution, normals.size(),
      [&](std::size_t vertex)
      {
        const auto leastOf = [&](const Vector& normal)
        { return leastCosine(points.positions, triangles, outgoing, vertex, normal); };
        const double least = leastOf(normals[vertex]);
        if (least < 0.0)
        {
          const Vector mean = angleNormal(points.positions, triangles, outgoing, vertex);
          const bool isBetter = hasDirection(mean) && leastOf(directionOf(mean)) > least;
          normals[vertex] = isBetter ? directionOf(mean) : normals[vertex];
        }
      });
  }
  return normals;
}

} // namespace isopoint
