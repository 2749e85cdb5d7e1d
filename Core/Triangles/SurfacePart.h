// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

struct SurfacePart
{
  std::vector<std::size_t> vertices;      // their numbers in the whole surface, ascending
  std::vector<bool> areGhosts;            // whether each is counted on another rank
  std::vector<SurfaceTriangle> triangles; // indices into `vertices`; ghosts last
  std::size_t ghostCount = 0;
};

/// Chooses the part of one rank: triangles belong to the rank of their first vertex, vertices are
/// counted on the rank of their first triangle.
class SurfacePartChoice
{
public:
  /// @param wholeSurface every vertex has a triangle
  /// @param vertexRanks the rank of each vertex
  SurfacePartChoice(const std::vector<SurfaceTriangle>& wholeSurface,
    const std::vector<std::size_t>& vertexRanks, std::size_t rank)
    : Triangles(wholeSurface)
    , VertexRanks(vertexRanks)
    , Rank(rank)
    , RingOf(wholeSurface.size(), outside)
    , IsInside(vertexRanks.size(), false)
  {
  }

  /// @param ghostRings number of rings of other ranks' triangles to add, each with all triangles
  /// that share a vertex with the part so far
  /// Complexity: O(vertices + triangles) per ring
  SurfacePart choose(int ghostRings)
  {
    for (int ring = 0; ring <= ghostRings; ++ring)
    {
      this->addRing(ring);
    }
    SurfacePart part;
    const std::vector<std::size_t> placeOf = this->chooseVertices(part);
    for (const bool areGhosts : { false, true })
    {
      for (std::size_t i = 0; i < this->Triangles.size(); ++i)
      {
        if (areGhosts ? this->RingOf[i] > 0 : this->RingOf[i] == 0)
        {
          const auto& [a, b, c] = this->Triangles[i];
          part.triangles.push_back({ placeOf[a], placeOf[b], placeOf[c] });
          part.ghostCount += areGhosts ? 1 : 0;
        }
      }
    }
    return part;
  }

private:
  static constexpr int outside = -1;

  std::size_t rankOf(const SurfaceTriangle& triangle) const
  {
    return this->VertexRanks[triangle[0]];
  }

  void addRing(int ring)
  {
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      const SurfaceTriangle& triangle = this->Triangles[i];
      const bool isAdded = ring == 0
                             ? this->rankOf(triangle) == this->Rank
                             : std::any_of(triangle.begin(), triangle.end(),
                                 [this](std::size_t vertex) { return this->IsInside[vertex]; });
      if (isAdded && this->RingOf[i] == outside)
      {
        this->RingOf[i] = ring;
      }
    }
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      for (const std::size_t vertex : this->Triangles[i])
      {
        this->IsInside[vertex] = this->IsInside[vertex] || this->RingOf[i] == ring;
      }
    }
  }

  /// @returns the places of vertices in the part
  std::vector<std::size_t> chooseVertices(SurfacePart& part) const
  {
    std::vector<bool> isMet(this->IsInside.size(), false);
    std::vector<bool> isCounted(this->IsInside.size(), false);
    for (const SurfaceTriangle& triangle : this->Triangles)
    {
      for (const std::size_t vertex : triangle)
      {
        isCounted[vertex] =
          isMet[vertex] ? isCounted[vertex] : this->rankOf(triangle) == this->Rank;
        isMet[vertex] = true;
      }
    }
    std::vector<std::size_t> placeOf(this->IsInside.size(), 0);
    for (std::size_t vertex = 0; vertex < placeOf.size(); ++vertex)
    {
      if (this->IsInside[vertex])
      {
        placeOf[vertex] = part.vertices.size();
        part.vertices.push_back(vertex);
        part.areGhosts.push_back(!isCounted[vertex]);
      }
    }
    return placeOf;
  }

  const std::vector<SurfaceTriangle>& Triangles;
  const std::vector<std::size_t>& VertexRanks;
  const std::size_t Rank;
  std::vector<int> RingOf;    // of each triangle
  std::vector<bool> IsInside; // whether each vertex is in a ring so far
};

} // namespace isopoint
