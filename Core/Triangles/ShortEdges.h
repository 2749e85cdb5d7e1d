// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceMesh.h"

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
/// @returns each edge once
/// @throws std::bad_alloc, Aborted
std::vector<VertexPair> shortEdges(
  const Execution& execution, const std::vector<Vector>& positions, const SurfaceMesh& mesh);

} // namespace isopoint
