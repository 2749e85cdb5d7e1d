// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// The number of rounds in which short edges are merged.
constexpr int shortEdgeRounds = 3;

/// The vertices of an edge, the lower one first.
using VertexPair = std::pair<std::size_t, std::size_t>;

/// Edges shorter than 0.55 sides of an equilateral triangle, shortest first in units of that side.
/// Its area is the mean of the areas of the triangles at both ends. O(n log n)
/// @returns an edge of several triangles several times
/// @throws std::bad_alloc
std::vector<VertexPair> shortEdges(
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint
