// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Triangles whose vertices may be merged.
struct MergeableTriangles
{
  const std::vector<Vector>& crossings;   // positions of the vertices
  std::vector<SurfaceTriangle> triangles; // ordered
  std::vector<SurfaceTriangle> caps;   // those of caps, if the surface is closed by them; ordered
  std::vector<std::size_t> nearerEnds; // the number of the nearer sample on each vertex' edge
  std::size_t endCount = 0;            // exceeds all of these numbers
  std::vector<char> areFixed = {};     // vertices that stay; empty for none
  bool keepsRim = false;               // whether vertices of edges with one triangle stay, too
};

/// Triangles between crossings of edges, or means of crossings.
struct CrossingMesh
{
  std::vector<Vector> positions;
  std::vector<SurfaceTriangle> triangles; // ordered
  std::vector<SurfaceTriangle> caps;      // those of caps; ordered
  /// The crossings whose mean each vertex is, nearest first, one list after the other.
  std::vector<std::size_t> members;
  std::vector<std::size_t> memberBegins; // by vertex, with an end; empty if each is one crossing

  std::size_t size() const { return this->positions.size(); }

  std::size_t firstMember(std::size_t vertex) const
  {
    return this->members[this->memberBegins.empty() ? vertex : this->memberBegins[vertex]];
  }
};

/// Merges crossings to about one vertex per sample next to the surface ([TPG99]), and then short
/// edges, if the topology allows: docs/triangles.md, "Regularization". Triangles between three
/// fixed vertices and the shape of caps (see CapRim) stay. The result depends only on the order of
/// vertices and triangles.
/// Complexity: O(n log n)
/// @throws std::bad_alloc, Aborted
CrossingMesh mergeVertices(const Execution& execution, MergeableTriangles triangles);

/// Reorders the vertices, or leaves out those without triangles. @throws std::bad_alloc, Aborted
CrossingMesh inOrder(
  const Execution& execution, const CrossingMesh& mesh, const std::vector<std::size_t>& order);

} // namespace isopoint
