// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/ShortEdges.h"

#include "Core/Base/Lists.h"
#include "Core/Base/Sorting.h"

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
  const std::vector<double> areas = tabulated<double>(execution, mesh.triangles().size(),
    [&](std::size_t triangle)
    { return 0.5 * lengthOf(areaNormal(positions, mesh.triangles()[triangle])); });
  struct Around // of the triangles at a vertex
  {
    double area;
    double count;
  };
  const std::vector<Around> around = tabulated<Around>(execution, positions.size(),
    [&](std::size_t vertex)
    {
      Around sum{ 0.0, 0.0 };
      mesh.outgoing().forEachAt(vertex,
        [&](HalfEdge side)
        {
          sum.area += areas[side / 3];
          sum.count += 1.0;
        });
      return sum;
    });
  using Measured = std::pair<double, VertexPair>; // the length in sides, and the edge
  std::vector<Measured> byLength = collectedFromEach<Measured>(execution, 3 * areas.size(),
    [&](HalfEdge side, std::vector<Measured>& found)
    {
      const auto [a, b] = std::minmax({ mesh.startOf(side), mesh.endOf(side) });
      const double area = (around[a].area + around[b].area) / (around[a].count + around[b].count);
      const double share =
        mesh.isFirst(side) ? lengthOf(positions[b] - positions[a]) / (equilateral * std::sqrt(area))
                           : shortEdge;
      if (share < shortEdge)
      {
        found.push_back({ share, { a, b } });
      }
    });
  constexpr double steps = 0x1p40;
  byLength = sortedUnique(execution, byLength, static_cast<std::uint64_t>(shortEdge * steps) + 1,
    [](const Measured& edge) { return static_cast<std::uint64_t>(edge.first * steps); });
  return tabulated<VertexPair>(
    execution, byLength.size(), [&](std::size_t i) { return byLength[i].second; });
}

} // namespace isopoint
