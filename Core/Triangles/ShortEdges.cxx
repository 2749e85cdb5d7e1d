// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ShortEdges.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace isopoint
{

std::vector<VertexPair> shortEdges(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles)
{
  constexpr double shortEdge = 0.55;
  constexpr double equilateral = 1.5196713713031851; // side over the root of the area
  const auto edgeOf = [&](std::size_t a, std::size_t b) { return positions[b] - positions[a]; };
  std::vector<double> areas(positions.size(), 0.0); // of the triangles around
  std::vector<double> counts(positions.size(), 0.0);
  forEachInOrder(execution, triangles.size(),
    [&](std::size_t triangle)
    {
      const auto& [a, b, c] = triangles[triangle];
      const double area = 0.5 * lengthOf(cross(edgeOf(a, b), edgeOf(a, c)));
      for (const std::size_t vertex : { a, b, c })
      {
        areas[vertex] += area;
        counts[vertex] += 1.0;
      }
    });
  using Measured = std::pair<double, VertexPair>; // the length in sides, and the edge
  constexpr std::size_t grain = 4096;
  std::vector<Measured> byLength = collected<Measured>(execution,
    { triangles.size(), 4 * grain, grain },
    [&](std::size_t begin, std::size_t end, std::vector<Measured>& found)
    {
      for (std::size_t triangle = begin; triangle < end; ++triangle)
      {
        for (std::size_t i = 0; i < 3; ++i)
        {
          const auto [a, b] = std::minmax(triangles[triangle][i], triangles[triangle][(i + 1) % 3]);
          const double area = (areas[a] + areas[b]) / (counts[a] + counts[b]);
          const double share = lengthOf(edgeOf(a, b)) / (equilateral * std::sqrt(area));
          if (share < shortEdge)
          {
            found.push_back({ share, { a, b } });
          }
        }
      }
    });
  constexpr double steps = 0x1p40;
  byLength = sortedUnique(execution, byLength, static_cast<std::uint64_t>(shortEdge * steps) + 1,
    [](const Measured& edge) { return static_cast<std::uint64_t>(edge.first * steps); });
  std::vector<VertexPair> edges(byLength.size());
  forEachIndex(execution, edges.size(), [&](std::size_t i) { edges[i] = byLength[i].second; });
  return edges;
}

} // namespace isopoint
