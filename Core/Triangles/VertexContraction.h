// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

struct WeightedVertices
{
  std::vector<Vector> positions;
  std::vector<double> weights; // number of crossings that each vertex is the mean of
};

/// Merges connected vertices of groups: docs/triangles.md, "Regularization".
class VertexContraction
{
public:
  /// Keeps references to all arguments. Triangles around grouped vertices must form a (half) disk.
  /// @param groups of the vertices, below groupCount; only vertices of one group are merged
  /// @throws std::bad_alloc, Aborted
  VertexContraction(const Execution& execution, const WeightedVertices& vertices,
    const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& groups,
    std::size_t groupCount);

  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(n log n), mostly
  void contract();

  /// The lowest vertex merged with a vertex.
  std::size_t rootOf(std::size_t vertex) const { return this->Roots[vertex]; }

  /// The position of a merged vertex.
  const Vector& positionOf(std::size_t root) const { return this->Positions[root]; }

  /// The vertices that determine the position of a root, ascending.
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

  const Execution& Exec;
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
