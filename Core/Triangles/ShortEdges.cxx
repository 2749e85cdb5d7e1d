// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ShortEdges.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace isopoint
{

std::vector<VertexPair> shortEdges(
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles)
{
  constexpr double shortEdge = 0.55;
  constexpr double equilateral = 1.5196713713031851; // side over the root of the area
  const auto edgeOf = [&](std::size_t a, std::size_t b) { return positions[b] - positions[a]; };
  std::vector<double> areas(positions.size(), 0.0); // of the triangles around
  std::vector<double> counts(positions.size(), 0.0);
  for (const auto& [a, b, c] : triangles)
  {
    const double area = 0.5 * lengthOf(cross(edgeOf(a, b), edgeOf(a, c)));
    for (const std::size_t vertex : { a, b, c })
    {
      areas[vertex] += area;
      counts[vertex] += 1.0;
    }
  }
  std::vector<std::pair<double, VertexPair>> byLength;
  for (const SurfaceTriangle& triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [a, b] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      const double area = (areas[a] + areas[b]) / (counts[a] + counts[b]);
      const double share = lengthOf(edgeOf(a, b)) / (equilateral * std::sqrt(area));
      if (share < shortEdge)
      {
        byLength.push_back({ share, { a, b } });
      }
    }
  }
  std::sort(byLength.begin(), byLength.end());
  std::vector<VertexPair> edges;
  std::transform(byLength.begin(), byLength.end(), std::back_inserter(edges),
    [](const auto& edge) { return edge.second; });
  return edges;
}

} // namespace isopoint
