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
