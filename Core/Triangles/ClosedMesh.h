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

/// Makes triangles whose sides are paired a closed 2-manifold. Vertices at one point are merged:
/// triangles that vanish are left out, and the sides beyond them become twins. Then vertices are
/// repeated, one for each fan. Where several edges have the same two vertices nevertheless, their
/// triangles are paired anew, which separates fans.
/// Complexity: O(n log n) for each round of pairing anew, mostly one
/// @param twins of the sides of all triangles; each side has one
/// @param pointOf by vertex of the triangles
/// @param pointCount exceeds all points
/// @throws std::bad_alloc, Aborted
ClosedTriangles closedTriangles(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<HalfEdge>& twins,
  const std::vector<std::size_t>& pointOf, std::size_t pointCount);

} // namespace isopoint
