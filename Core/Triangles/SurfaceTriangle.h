// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"

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

/// The triangles with vertices numbered by their places in an order; ordered().
/// @param order of all their vertices
/// @param vertexCount exceeds every vertex
/// @throws std::bad_alloc, Aborted
std::vector<SurfaceTriangle> renumbered(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<std::size_t>& order,
  std::size_t vertexCount);

} // namespace isopoint
