// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/SplatMesh/SplatMesh.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace isopoint
{

namespace
{

/// The vertices of one of a fan's triangles. Flips a triangle that faces away because two corners
/// have passed each other; it would be dark.
std::array<std::size_t, 3> facingTriangle(const SplatFan& fan, std::size_t triangle)
{
  std::array<std::size_t, 3> corners = fan.triangles[triangle];
  const Vector& a = fan.positions[corners[0]];
  const Vector side = fan.positions[corners[1]] - a;
  const Vector other = fan.positions[corners[2]] - a;
  if (dot(cross(side, other), fan.normals[corners[0]]) < 0.0)
  {
    std::swap(corners[1], corners[2]);
  }
  return corners;
}

} // namespace

SplatMesh buildSplatMesh(const Execution& execution, std::size_t points,
  const std::function<SplatFan(std::size_t point)>& fanAt)
{
  constexpr double third = 1.0 / 3.0;
  std::vector<std::size_t> firstVertices(points + 1, 0);
  std::vector<std::size_t> firstTriangles(points + 1, 0);
  forEachIndex(
    execution, points,
    [&](std::size_t point)
    {
      const SplatFan fan = fanAt(point);
      firstVertices[point + 1] = fan.vertexCount;
      firstTriangles[point + 1] = fan.triangleCount;
    },
    partOf(execution, 0.0, third).progress);
  std::partial_sum(firstVertices.begin(), firstVertices.end(), firstVertices.begin());
  std::partial_sum(firstTriangles.begin(), firstTriangles.end(), firstTriangles.begin());

  std::vector<SplatVertex> vertices(firstVertices.back());
  std::vector<std::size_t> pointOfVertex(vertices.size());
  std::vector<std::array<std::size_t, 3>> triangles(firstTriangles.back());
  forEachIndex(
    execution, points,
    [&](std::size_t point)
    {
      const SplatFan fan = fanAt(point);
      const std::size_t first = firstVertices[point];
      for (std::size_t i = 0; i < fan.vertexCount; ++i)
      {
        const Vector& normal = fan.normals[i];
        vertices[first + i] = { fan.positions[i],
          { static_cast<float>(normal[0]), static_cast<float>(normal[1]),
            static_cast<float>(normal[2]) },
          fan.tolerance };
        pointOfVertex[first + i] = point;
      }
      for (std::size_t i = 0; i < fan.triangleCount; ++i)
      {
        const auto [a, b, c] = facingTriangle(fan, i);
        triangles[firstTriangles[point] + i] = { first + a, first + b, first + c };
      }
    },
    partOf(execution, third, 2.0 * third).progress);

  std::vector<std::size_t> meetsAt = meetingVertices(partOf(execution, 2.0 * third, 1.0), vertices);
  ItemLists meeting(execution, vertices.size(), vertices.size(),
    [&meetsAt](std::size_t vertex) { return std::array<std::size_t, 1>{ meetsAt[vertex] }; });
  // Corners of neighbors differ by rounding. Pixels between them would show the background. The
  // least position does not depend on the order of the points.
  forEachIndex(execution, vertices.size(),
    [&](std::size_t first)
    {
      const IndexSpan<std::size_t> met = meeting.at(first);
      Vector least = vertices[first].position;
      for (const std::size_t vertex : met)
      {
        least = std::min(least, vertices[vertex].position);
      }
      for (const std::size_t vertex : met)
      {
        vertices[vertex].position = least;
      }
    });
  return { std::move(vertices), std::move(pointOfVertex), std::move(triangles), std::move(meetsAt),
    std::move(meeting) };
}

} // namespace isopoint
