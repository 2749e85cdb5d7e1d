// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// Sets of at least two vertices, connected by edges of triangles, that are to become one.
struct VertexParts
{
  struct Part
  {
    std::size_t begin; // among the vertices
    std::size_t end;
  };

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::size_t size() const { return this->parts.size(); }

  bool isInside(std::size_t vertex, std::size_t part) const { return this->partOf[vertex] == part; }

  /// Whether a vertex is in a part with a mark.
  bool isMarked(std::size_t vertex, const std::vector<char>& ofParts) const
  {
    return this->partOf[vertex] != none && ofParts[this->partOf[vertex]] != 0;
  }

  /// The lowest vertex of the part of a vertex, if the part has a mark; else the vertex.
  std::size_t rootOf(std::size_t vertex, const std::vector<char>& ofParts) const
  {
    return this->isMarked(vertex, ofParts) ? this->verticesOf(this->partOf[vertex])[0] : vertex;
  }

  /// Ascending.
  IndexSpan<std::size_t> verticesOf(std::size_t part) const
  {
    const Part& own = this->parts[part];
    return { this->vertices.data() + own.begin, own.end - own.begin };
  }

  /// @param vertexCount of the mesh
  /// @throws std::bad_alloc, Aborted
  VertexParts(const Execution& execution, std::vector<std::size_t> allVertices,
    std::vector<Part> allParts, std::size_t vertexCount);

  std::vector<std::size_t> vertices;
  std::vector<Part> parts;
  std::vector<std::size_t> partOf; // each vertex of the mesh; or none
};

/// The connected parts of groups of vertices, ordered by group and first vertex.
/// @param groups of the vertices, below groupCount. The triangles around vertices in groups of
/// several form a (half) disk
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles + groups), and O(n log n) for the vertices of one group
VertexParts partsOfGroups(const Execution& execution, const SurfaceMesh& mesh,
  const std::vector<std::size_t>& groups, std::size_t groupCount);

/// Which parts can each become one vertex, all at once, without a change of topology:
/// docs/triangles.md, "Regularization".
/// @param parts the triangles around their vertices form a (half) disk
/// @param areWanted the parts that may become one vertex
/// @returns for each part whether it can
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n), mostly
std::vector<char> contractibleParts(const Execution& execution, const SurfaceMesh& mesh,
  const VertexParts& parts, std::vector<char> areWanted);

} // namespace isopoint
