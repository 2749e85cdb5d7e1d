// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_VertexLink_h
#define isopoint_VertexLink_h

#include "Core/Base/Execution.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

using DirectedEdge = std::pair<std::size_t, std::size_t>;

/// The edges opposite to a vertex in the triangles around it. Memory is kept.
class VertexLink
{
public:
  void clear() { this->Edges.clear(); }

  /// Adds an edge, counterclockwise seen from outside.
  void add(std::size_t from, std::size_t to) { this->Edges.emplace_back(from, to); }

  /// Sorts what was added, and finds out whether it is one cycle of at least three edges, or one
  /// path: whether the triangles around the vertex are a disk, or half of one at a border.
  /// O(n log n)
  bool isCycleOrPath();

  /// Whether the sorted edges have a vertex.
  bool hasVertex(std::size_t vertex) const;

  /// Of a cycle or path.
  std::size_t vertexCount() const { return this->Edges.size() + (this->IsPath ? 1 : 0); }

private:
  std::vector<DirectedEdge> Edges;
  std::vector<std::size_t> Ends; // of the edges
  bool IsPath = false;
};

/// The vertices, ascending, around which triangles are neither a disk nor half of one.
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
std::vector<std::size_t> branchedVertices(
  const Execution& execution, const std::vector<SurfaceTriangle>& triangles, std::size_t count);

} // namespace isopoint

#endif
