// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Triangles/TriangleGeometry.h"

#include "Isopoint/Base/RawArray.h"
#include "Isopoint/Base/SortUnique.h"
#include "Isopoint/Splat/SplatNormals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

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

/// A vertex, and a triangle that has it.
using Corner = std::pair<std::size_t, std::size_t>;

std::vector<Corner> cornersByVertex(const std::vector<SurfaceTriangle>& triangles)
{
  std::vector<Corner> corners;
  reserveOnHugePages(corners, 3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (const std::size_t vertex : triangles[i])
    {
      corners.emplace_back(vertex, i);
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// @param corners ordered
void addTrianglesAt(
  std::size_t vertex, const std::vector<Corner>& corners, std::vector<std::size_t>& triangles)
{
  auto corner = std::lower_bound(corners.begin(), corners.end(), Corner(vertex, 0));
  for (; corner != corners.end() && corner->first == vertex; ++corner)
  {
    triangles.push_back(corner->second);
  }
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
  std::vector<std::size_t> number = onHugePages<std::size_t>(vertexCount);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    number[order[place]] = place;
  }
  std::vector<SurfaceTriangle> result;
  reserveOnHugePages(result, triangles.size());
  for (const auto& [a, b, c] : triangles)
  {
    SurfaceTriangle corners{ number[a], number[b], number[c] };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(corners);
  }
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
  std::vector<std::size_t> suspects = onHugePages<std::size_t>(triangles.size());
  std::iota(suspects.begin(), suspects.end(), std::size_t{ 0 });
  std::vector<Corner> corners; // ordered, once there is a triangle that is turned over
  while (!suspects.empty())
  {
    constexpr std::size_t grain = 8192;
    const std::vector<std::size_t> turned =
      collected<std::size_t>(execution, { suspects.size(), 8 * grain, grain },
        [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found)
        {
          std::copy_if(suspects.begin() + static_cast<std::ptrdiff_t>(begin),
            suspects.begin() + static_cast<std::ptrdiff_t>(end), std::back_inserter(found),
            [&](std::size_t triangle) { return isTurned(triangles[triangle]); });
        });
    if (corners.empty() && !turned.empty())
    {
      corners = cornersByVertex(triangles);
    }
    suspects.clear();
    for (const std::size_t triangle : turned)
    {
      for (const std::size_t vertex : triangles[triangle])
      {
        if (isMoved(vertex))
        {
          addTrianglesAt(vertex, corners, suspects);
        }
        fits[vertex].order.reset();
        fits[vertex].position = unmoved[vertex];
      }
    }
    keepUnique(suspects);
  }
}

std::vector<Splat> vertexNormals(
  const SurfacePoints& points, const std::vector<SurfaceTriangle>& triangles, bool areOfField)
{
  std::vector<Splat> splats = onHugePages<Splat>(points.positions.size());
  SplatOptions options;
  options.fieldNormals = areOfField;
  const std::vector<std::size_t> others = setFieldNormals(points, options, splats);
  if (others.empty())
  {
    return splats;
  }
  std::vector<bool> isOther(splats.size(), false);
  for (const std::size_t vertex : others)
  {
    isOther[vertex] = true;
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
        splats[vertex].normal = sum(splats[vertex].normal, 1.0, normal);
      }
    }
  }
  for (const std::size_t vertex : others)
  {
    Vector& normal = splats[vertex].normal;
    normal = directionOf(hasDirection(normal) ? normal : points.decreasingEdges[vertex]);
  }
  return splats;
}

} // namespace isopoint
