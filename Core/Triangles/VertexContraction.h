// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_VertexContraction_h
#define isopoint_VertexContraction_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"
#include "Core/Triangles/VertexLink.h"
#include "Core/Triangles/VertexParts.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// Vertices of a surface that are means of others.
struct WeightedVertices
{
  std::vector<Vector> positions;
  std::vector<double> weights; // how many others each of them is the mean of
};

/// Makes one vertex of each part of a surface's vertices, as far as the topology stays:
/// docs/triangles.md, "Regularization".
class VertexContraction
{
public:
  /// All kept by the caller. Around vertices that have others in their group, triangles are a disk
  /// or half of one.
  /// @param groups of the vertices, below groupCount: those of one group may become one
  /// @throws std::bad_alloc, Aborted
  VertexContraction(const Execution& execution, const WeightedVertices& vertices,
    const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& groups,
    std::size_t groupCount);

  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(n log n), mostly
  void contract();

  /// The first of the vertices that one became a vertex with.
  std::size_t rootOf(std::size_t vertex) const { return this->Roots[vertex]; }

  /// Where the vertex of a root is.
  const Vector& positionOf(std::size_t root) const { return this->Positions[root]; }

  /// The vertices whose mean the vertex of a root is, ascending.
  std::vector<std::size_t> membersOf(std::size_t root) const;

private:
  struct Surroundings;

  void findBorder();
  std::vector<std::size_t> placingMembers(std::size_t part) const;
  std::size_t cornerOf(std::size_t part, const std::vector<std::size_t>& atBorder) const;
  void merge(std::size_t part);
  Vector meanOf(const std::vector<std::size_t>& vertices) const;
  void separate(std::size_t part);
  bool isSurface(std::size_t part, Surroundings& around) const;
  std::vector<std::size_t> lowestAmongNeighbors(const std::vector<std::size_t>& failed) const;

  template <class Visit>
  void forPartsAround(std::size_t part, const Visit& visit) const;

  const Execution& Run;
  const WeightedVertices& Vertices;
  const std::vector<SurfaceTriangle>& Triangles;
  VertexParts Parts;
  std::vector<char> IsMerged; // each part
  // Of each vertex.
  std::vector<char> IsAtBorder;
  std::vector<std::size_t> Roots;
  std::vector<Vector> Positions; // of each root
};

} // namespace isopoint

#endif
