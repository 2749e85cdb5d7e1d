// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Triangles/SurfacePart.h"

#include "Core/Base/Lists.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <algorithm>
#include <utility>

namespace isopoint
{

SurfacePart partOfRank(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
  const std::vector<std::size_t>& vertexRanks, std::size_t rank, int ghostRings)
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
    forEachIndex(execution, areInside.size(),
      [&](std::size_t vertex)
      {
        const bool isInside =
          outgoing.anyAt(vertex, [&rings](HalfEdge side) { return rings[side / 3] != outside; });
        areInside[vertex] = isInside ? 1 : 0;
      });
  }
  SurfacePart part;
  part.vertices = markedOf(execution, areInside);
  part.areGhosts.resize(part.vertices.size());
  std::vector<std::size_t> places(areInside.size(), 0); // in the part
  forEachInOrder(execution, part.vertices.size(),
    [&](std::size_t i)
    {
      const std::size_t vertex = part.vertices[i];
      part.areGhosts[i] = !isOwn(outgoing.firstAt(vertex) / 3);
      places[vertex] = i;
    });
  std::vector<std::size_t> chosen =
    itemsThat(execution, rings.size(), [&rings](std::size_t i) { return rings[i] == 0; });
  const std::vector<std::size_t> ghosts =
    itemsThat(execution, rings.size(), [&rings](std::size_t i) { return rings[i] > 0; });
  chosen.insert(chosen.end(), ghosts.begin(), ghosts.end());
  part.ghostCount = ghosts.size();
  part.triangles.resize(chosen.size());
  forEachIndex(execution, chosen.size(),
    [&](std::size_t i)
    {
      const auto& [a, b, c] = triangles[chosen[i]];
      part.triangles[i] = { places[a], places[b], places[c] };
    });
  part.triangleNumbers = std::move(chosen);
  return part;
}

} // namespace isopoint
