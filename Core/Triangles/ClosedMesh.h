// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Triangles of a closed surface: each side has a twin, and each vertex one fan.
struct ClosedTriangles
{
  std::vector<std::size_t> points;        // of the vertices; ascending, repeated at fans that meet
  std::vector<SurfaceTriangle> triangles; // of vertices, ordered; those of equal vertices by source
  std::vector<std::size_t> sources;       // of the triangles: their indices before
};

/// Makes a closed 2-manifold of triangles with paired sides:
/// 1. Merges the vertices at one point. Drops triangles that vanish, and pairs the sides beyond
/// them.
/// 2. Repeats a vertex for each of its fans.
/// 3. If several edges still have the same two vertices, exchanges their twins, which separates
/// fans, and repeats step 2.
/// Complexity: O(n log n) for each round of pairing anew, mostly one
/// @param twins of the sides of all triangles; each side has one
/// @param pointOf by vertex of the triangles
/// @param pointCount exceeds all points
/// @throws std::bad_alloc, Aborted
ClosedTriangles closedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<HalfEdge>& twins,
  const std::vector<std::size_t>& pointOf, std::size_t pointCount);

} // namespace isopoint
