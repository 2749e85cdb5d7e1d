// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TriangleGeometry_h
#define isopoint_TriangleGeometry_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Splat/Splat.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Three different vertices of a surface, the lowest first. Seen from the side of lower values they
/// stand counterclockwise: the right-hand normal points to decreasing values.
using SurfaceTriangle = std::array<std::size_t, 3>;

/// The vertices of triangles, each once, in ascending order.
/// @param vertexCount above every vertex
std::vector<std::size_t> verticesOf(
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount);

/// Triangles from their lowest vertices on: ordered, each once.
/// @param vertexCount above every vertex
/// @throws std::bad_alloc, Aborted
std::vector<SurfaceTriangle> ordered(
  const Execution& execution, std::vector<SurfaceTriangle> triangles, std::size_t vertexCount);

/// Triangles whose vertices are numbered by their places in an order, and then ordered().
/// @param order of all their vertices
/// @param vertexCount above every vertex
/// @throws std::bad_alloc, Aborted
std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& order,
  std::size_t vertexCount);

/// Takes back those moves of vertices by fits that are more than twice as long as all edges of the
/// vertex's triangles, and then those that would turn triangles over. A triangle is turned over if
/// the right-hand normal of its unmoved vertices has a positive product with the sum of the
/// directions against the three gradients, and that of the moved ones has not: then the three
/// vertices stay, as if no fit held; until no triangle is turned over. (Linear interpolation alone
/// leaves some that look the wrong way in flat tetrahedra.)
/// Vertices of fits with creases, and their triangles, are left to meshCreases().
/// @param unmoved positions of the vertices
/// @param fits of the vertices; those whose vertices stay have no order and that position
/// @throws std::bad_alloc, Aborted
/// Complexity: O(vertices + triangles), and O(n log n) where many are turned over, however many
/// rounds it takes
void keepTrianglesUpright(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, std::vector<LocalFit>& fits);

/// The normals of vertices: against the fits' gradients, if wanted and where there are such; else
/// the mean of the normals of their triangles, weighted by area. So it is where a fit has failed:
/// where its normal is more than 60 degrees off this mean and that of the neighbors' means. Fits
/// with creases do not fail.
/// @throws std::bad_alloc
std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField);

} // namespace isopoint

#endif
