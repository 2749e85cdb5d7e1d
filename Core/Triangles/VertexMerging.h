// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_VertexMerging_h
#define isopoint_VertexMerging_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Triangles whose vertices are means of crossings.
struct MergedTriangles
{
  std::vector<Vector> positions;
  std::vector<SurfaceTriangle> triangles; // ordered
  /// The crossings whose mean each vertex is, the nearest to it first, one list after the other.
  std::vector<std::size_t> members;
  std::vector<std::size_t> memberBegins; // by vertex, and the end of the last list

  std::size_t size() const { return this->positions.size(); }
};

/// Merges the crossings of a surface to about one vertex for each sample next to it ([TPG99]), and
/// then short edges, as far as the topology stays: docs/triangles.md, "Regularization". The result
/// depends on the order of vertices and triangles, and on nothing else.
/// @param crossings positions of the vertices
/// @param nearerEnds the number of the sample that is nearest to each crossing on its edge
/// @param endCount above all of these numbers
/// @param triangles ordered
/// @param areKept whether each vertex stays as it is (so do triangles between three of these), or
/// empty for none
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
MergedTriangles mergeVertices(const Execution& execution, const std::vector<Vector>& crossings,
  const std::vector<std::size_t>& nearerEnds, std::size_t endCount,
  std::vector<SurfaceTriangle> triangles, std::vector<char> areKept = {});

} // namespace isopoint

#endif
