// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

using DirectedEdge = std::pair<std::size_t, std::size_t>;

/// The edges opposite a vertex in its triangles. Reuses memory.
class VertexLink
{
public:
  void clear() { this->Edges.clear(); }

  /// Adds an edge, counterclockwise seen from outside.
  void add(std::size_t from, std::size_t to) { this->Edges.emplace_back(from, to); }

  /// Sorts the edges. @returns whether they form one path, or one cycle of at least three edges:
  /// the triangles around the vertex are a half disk or a disk. O(n log n)
  bool isCycleOrPath();

  /// Whether a sorted edge has a vertex.
  bool hasVertex(std::size_t vertex) const;

  /// For a cycle or path.
  std::size_t vertexCount() const { return this->Edges.size() + (this->IsPath ? 1 : 0); }

private:
  std::vector<DirectedEdge> Edges;
  std::vector<std::size_t> Ends; // of the edges
  bool IsPath = false;
};

/// The vertices whose triangles form neither a disk nor a half disk, ascending. O(n log n)
/// @throws std::bad_alloc, Aborted
std::vector<std::size_t> branchedVertices(
  const Execution& execution, const std::vector<SurfaceTriangle>& triangles, std::size_t count);

} // namespace isopoint
