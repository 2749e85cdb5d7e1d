// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Three different vertices, lowest first; the right-hand normal points to decreasing values.
using SurfaceTriangle = std::array<std::size_t, 3>;

/// The distinct vertices of triangles, ascending.
/// @param vertexCount exceeds every vertex
/// @throws std::bad_alloc, Aborted
std::vector<std::size_t> verticesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount);

/// By vertex, whether it is one of the triangles. @throws std::bad_alloc, Aborted
/// @param vertexCount exceeds every vertex
std::vector<char> areVerticesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount);

/// By triangle, whether it is one of some. O(n log n) @throws std::bad_alloc, Aborted
/// @param some ordered()
std::vector<char> areAmong(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& some);

/// The distinct triangles, each starting at its lowest vertex, ordered.
/// @param vertexCount exceeds every vertex
/// @throws std::bad_alloc, Aborted
std::vector<SurfaceTriangle> ordered(
  const Execution& execution, std::vector<SurfaceTriangle> triangles, std::size_t vertexCount);

/// The triangles with other numbers of their vertices, without those of which two become one;
/// ordered().
/// @param numbers of all vertices, below count
/// @throws std::bad_alloc, Aborted
std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& numbers,
  std::size_t count);

/// The normal of a triangle, as long as twice its area.
inline Vector areaNormal(const std::vector<Vector>& positions, const SurfaceTriangle& triangle)
{
  const auto& [a, b, c] = triangle;
  return cross(positions[b] - positions[a], positions[c] - positions[a]);
}

} // namespace isopoint
