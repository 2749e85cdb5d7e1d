// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/TriangleGeometry.h"

#include "Core/Base/Collected.h"
#include "Core/Base/ItemLists.h"
#include "Core/Base/NodeList.h"
#include "Core/Base/SortUnique.h"
#include "Core/Splat/SplatNormals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>

namespace isopoint
{
namespace
{

/// The normal of a triangle, as long as twice its area in units that neither over- nor underflow:
/// its direction alone is of use.
Vector scaledNormal(const Vector& a, const Vector& b, const Vector& c)
{
  const Vector u = difference(b, a);
  const Vector v = difference(c, a);
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    largest = std::max({ largest, std::abs(u[axis]), std::abs(v[axis]) });
  }
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  const auto toUnit = [exponent](const Vector& w) -> Vector
  {
    return { std::ldexp(w[0], -exponent), std::ldexp(w[1], -exponent),
      std::ldexp(w[2], -exponent) };
  };
  return cross(toUnit(u), toUnit(v));
}

bool hasDirection(const Vector& vector)
{
  const double length = lengthOf(vector);
  return std::isfinite(length) && length > 0.0;
}

} // namespace

std::vector<std::size_t> verticesOf(
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount)
{
  std::vector<bool> isUsed(vertexCount, false);
  for (const SurfaceTriangle& triangle : triangles)
  {
    for (const std::size_t vertex : triangle)
    {
      isUsed[vertex] = true;
    }
  }
  return markedOf(isUsed);
}

std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& order,
  std::size_t vertexCount)
{
  std::vector<std::size_t> number(vertexCount);
  forEachIndex(execution, order.size(), [&](std::size_t place) { number[order[place]] = place; });
  std::vector<SurfaceTriangle> result(triangles.size());
  forEachIndex(execution, triangles.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[i];
      SurfaceTriangle& corners = result[i];
      corners = { number[a], number[b], number[c] };
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    });
  return sortedUnique(execution, result, order.size(),
    [](const SurfaceTriangle& triangle) { return static_cast<std::uint64_t>(triangle[0]); });
}

void keepTrianglesUpright(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, std::vector<LocalFit>& fits)
{
  const auto isMoved = [&fits](std::size_t vertex) { return fits[vertex].order.has_value(); };
  const auto fallingAt = [&fits](std::size_t vertex)
  { return scaled(-1.0, directionOf(fits[vertex].gradient)); };
  const auto isTurned = [&](const SurfaceTriangle& triangle)
  {
    const auto& [a, b, c] = triangle;
    const bool isAtCrease = std::any_of(triangle.begin(), triangle.end(),
      [&fits](std::size_t vertex) { return fits[vertex].order == FitOrder::Crease; });
    if (isAtCrease || (!isMoved(a) && !isMoved(b) && !isMoved(c)))
    {
      return false;
    }
    const auto placeOf = [&](std::size_t vertex)
    { return isMoved(vertex) ? fits[vertex].position : unmoved[vertex]; };
    const Vector before = scaledNormal(unmoved[a], unmoved[b], unmoved[c]);
    const Vector after = scaledNormal(placeOf(a), placeOf(b), placeOf(c));
    const Vector falling = sum(sum(fallingAt(a), 1.0, fallingAt(b)), 1.0, fallingAt(c));
    return dot(before, falling) > 0.0 && !(dot(after, falling) > 0.0);
  };
  // All at first, then those that changed.
  std::vector<std::size_t> suspects(triangles.size());
  std::iota(suspects.begin(), suspects.end(), std::size_t{ 0 });
  std::optional<ItemLists> trianglesAt; // each vertex, once one is turned over
  while (!suspects.empty())
  {
    constexpr std::size_t grain = 8192;
    const std::vector<std::size_t> turned = collected<std::size_t>(
      execution, { suspects.size(), 8 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
      {
        std::copy_if(suspects.begin() + static_cast<std::ptrdiff_t>(begin),
          suspects.begin() + static_cast<std::ptrdiff_t>(end), std::back_inserter(found),
          [&](std::size_t triangle) { return isTurned(triangles[triangle]); });
      },
      execution.progress);
    if (!trianglesAt && !turned.empty())
    {
      trianglesAt.emplace(fits.size(), triangles.size(),
        [&triangles](std::size_t triangle) -> const SurfaceTriangle&
        { return triangles[triangle]; });
    }
    suspects.clear();
    for (const std::size_t triangle : turned)
    {
      for (const std::size_t vertex : triangles[triangle])
      {
        if (isMoved(vertex))
        {
          const NodeList<std::size_t> around = trianglesAt->at(vertex);
          suspects.insert(suspects.end(), around.begin(), around.end());
        }
        fits[vertex].order.reset();
        fits[vertex].position = unmoved[vertex];
      }
    }
    keepUnique(suspects);
  }
}

std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField)
{
  std::vector<Vector> normals(points.positions.size());
  const std::vector<std::size_t> others = setFieldNormals(execution, points, areOfField,
    [&normals](std::size_t vertex, const Vector& normal) { normals[vertex] = normal; });
  if (others.empty())
  {
    return normals;
  }
  std::vector<char> isOther(normals.size(), 0);
  for (const std::size_t vertex : others)
  {
    isOther[vertex] = 1;
  }
  for (const SurfaceTriangle& triangle : triangles)
  {
    const auto& [a, b, c] = triangle;
    if (!isOther[a] && !isOther[b] && !isOther[c])
    {
      continue;
    }
    const Vector normal = cross(difference(points.positions[b], points.positions[a]),
      difference(points.positions[c], points.positions[a]));
    for (const std::size_t vertex : triangle)
    {
      if (isOther[vertex])
      {
        normals[vertex] = sum(normals[vertex], 1.0, normal);
      }
    }
  }
  for (const std::size_t vertex : others)
  {
    Vector& normal = normals[vertex];
    normal = directionOf(hasDirection(normal) ? normal : points.decreasingEdges[vertex]);
  }
  return normals;
}

} // namespace isopoint
