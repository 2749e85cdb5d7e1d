// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ShortEdges.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace isopoint
{

std::vector<VertexPair> shortEdges(
  const Execution& execution, const std::vector<Vector>& positions, const SurfaceMesh& mesh)
{
  constexpr double shortEdge = 0.55;
  constexpr double equilateral = 1.5196713713031851; // side over the root of the area
  const auto edgeOf = [&](std::size_t a, std::size_t b) { return positions[b] - positions[a]; };
  std::vector<double> areas(mesh.triangles().size());
  forEachIndex(execution, areas.size(),
    [&](std::size_t triangle)
    {
      const auto& [a, b, c] = mesh.triangles()[triangle];
      areas[triangle] = 0.5 * lengthOf(cross(edgeOf(a, b), edgeOf(a, c)));
    });
  struct Around // of the triangles at a vertex
  {
    double area;
    double count;
  };
  std::vector<Around> around(positions.size(), { 0.0, 0.0 });
  forEachIndex(execution, around.size(),
    [&](std::size_t vertex)
    {
      mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          around[vertex].area += areas[side / 3];
          around[vertex].count += 1.0;
        });
    });
  using Measured = std::pair<double, VertexPair>; // the length in sides, and the edge
  constexpr std::size_t grain = 4096;
  std::vector<Measured> byLength = collected<Measured>(execution,
    { 3 * areas.size(), 4 * grain, grain },
    [&](std::size_t begin, std::size_t end, std::vector<Measured>& found)
    {
      for (HalfEdge side = begin; side < end; ++side)
      {
        const auto [a, b] = std::minmax({ mesh.startOf(side), mesh.endOf(side) });
        const double area = (around[a].area + around[b].area) / (around[a].count + around[b].count);
        const double share = mesh.twinOf(side) == noHalfEdge || side < mesh.twinOf(side)
                               ? lengthOf(edgeOf(a, b)) / (equilateral * std::sqrt(area))
                               : shortEdge;
        if (share < shortEdge)
        {
          found.push_back({ share, { a, b } });
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
