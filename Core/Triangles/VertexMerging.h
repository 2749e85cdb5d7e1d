// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Triangles between means of crossings.
struct MergedTriangles
{
  std::vector<Vector> positions;
  std::vector<SurfaceTriangle> triangles; // ordered
  /// The crossings whose mean each vertex is, nearest first, one list after the other.
  std::vector<std::size_t> members;
  std::vector<std::size_t> memberBegins; // by vertex, with an end

  std::size_t size() const { return this->positions.size(); }
};

/// Merges crossings to about one vertex per sample next to the surface ([TPG99]), and then short
/// edges, if the topology allows: docs/triangles.md, "Regularization". The result depends only on
/// the order of vertices and triangles. O(n log n)
/// @param crossings positions of the vertices
/// @param nearerEnds the number of the nearer sample on the edge of each crossing
/// @param endCount exceeds all of these numbers
/// @param triangles ordered
/// @param areKept vertices that stay, as do triangles between three of them; empty for none
/// @param keepsRim whether vertices of edges with one triangle stay, too
/// @throws std::bad_alloc, Aborted
MergedTriangles mergeVertices(const Execution& execution, const std::vector<Vector>& crossings,
  const std::vector<std::size_t>& nearerEnds, std::size_t endCount,
  std::vector<SurfaceTriangle> triangles, std::vector<char> areKept = {}, bool keepsRim = false);

} // namespace isopoint
