// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SurfacePart_h
#define isopoint_SurfacePart_h

#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// A part of a surface of triangles.
struct SurfacePart
{
  std::vector<std::size_t> vertices;      // their numbers in the whole surface, ascending
  std::vector<bool> areElsewhere;         // whether each of them is counted on another rank
  std::vector<SurfaceTriangle> triangles; // of places in `vertices`, the ghosts last
  std::size_t ghostCount = 0;             // of the triangles
};

/// Chooses the part of one rank: triangles belong to the ranks of their first vertices, and a
/// vertex is counted on the rank of the first triangle that has it.
class SurfacePartChoice
{
public:
  /// @param wholeSurface whose vertices all have a triangle
  /// @param vertexRanks to which vertices belong, by number
  SurfacePartChoice(const std::vector<SurfaceTriangle>& wholeSurface,
    const std::vector<std::size_t>& vertexRanks, std::size_t rank)
    : Triangles(wholeSurface)
    , VertexRanks(vertexRanks)
    , Rank(rank)
    , RingOf(wholeSurface.size(), outside)
    , IsInside(vertexRanks.size(), false)
  {
  }

  /// @param ghostRings of triangles of other ranks that are added. A ring is all triangles with a
  /// vertex in the part within
  /// Complexity: O(vertices + triangles), for each ring
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
        part.areElsewhere.push_back(!isCounted[vertex]);
      }
    }
    return placeOf;
  }

  const std::vector<SurfaceTriangle>& Triangles;
  const std::vector<std::size_t>& VertexRanks;
  const std::size_t Rank;
  std::vector<int> RingOf;    // of each triangle
  std::vector<bool> IsInside; // whether each vertex is that of a triangle of the rings so far
};

} // namespace isopoint

#endif
