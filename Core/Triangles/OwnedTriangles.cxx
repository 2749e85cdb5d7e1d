// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/OwnedTriangles.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <algorithm>
#include <utility>

namespace isopoint
{

OwnedTriangles ownedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& vertexRanks,
  std::size_t rank, int ghostRings)
{
  constexpr int outside = -1;
  const OutgoingHalfEdges outgoing(execution, triangles, vertexRanks.size());
  std::vector<int> rings(triangles.size(), outside);
  std::vector<char> areInside(vertexRanks.size(), 0);
  const auto isOwn = [&](std::size_t triangle)
  { return vertexRanks[triangles[triangle][0]] == rank; };
  for (int ring = 0; ring <= ghostRings; ++ring)
  {
    forEachIndex(execution, triangles.size(),
      [&](std::size_t i)
      {
        const bool isAdded = ring == 0 ? isOwn(i)
                                       : std::any_of(triangles[i].begin(), triangles[i].end(),
                                           [&](std::size_t vertex) { return areInside[vertex]; });
        rings[i] = isAdded && rings[i] == outside ? ring : rings[i];
      });
    areInside = tabulated<char>(execution, vertexRanks.size(),
      [&](std::size_t vertex) {
        return outgoing.anyAt(vertex, [&](HalfEdge side) { return rings[side / 3] != outside; });
      });
  }
  OwnedTriangles owned;
  owned.vertices = markedOf(execution, areInside);
  const std::vector<char> areGhosts = tabulated<char>(execution, owned.vertices.size(),
    [&](std::size_t i) { return !isOwn(outgoing.firstAt(owned.vertices[i]) / 3); });
  owned.areGhosts.assign(areGhosts.begin(), areGhosts.end());
  const std::vector<std::size_t> numbers = inverseOf(execution, owned.vertices, areInside.size());
  std::vector<std::size_t> chosen =
    itemsThat(execution, rings.size(), [&rings](std::size_t i) { return rings[i] == 0; });
  const std::vector<std::size_t> ghosts =
    itemsThat(execution, rings.size(), [&rings](std::size_t i) { return rings[i] > 0; });
  chosen.insert(chosen.end(), ghosts.begin(), ghosts.end());
  owned.ghostCount = ghosts.size();
  owned.triangles = tabulated<SurfaceTriangle>(execution, chosen.size(),
    [&](std::size_t i) -> SurfaceTriangle
    {
      const auto& [a, b, c] = triangles[chosen[i]];
      return { numbers[a], numbers[b], numbers[c] };
    });
  owned.triangleNumbers = std::move(chosen);
  return owned;
}

} // namespace isopoint
