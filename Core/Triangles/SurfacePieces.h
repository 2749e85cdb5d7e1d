// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <vector>

namespace isopoint
{

/// Marks the triangles of small pieces of a surface, such as droplets. A piece is what is connected
/// by vertices. Closed pieces with a negative volume are bubbles, inner borders of a body, and are
/// never marked.
/// @param share of the largest piece's area, below which a piece is small
/// @returns by triangle
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n)
std::vector<char> areOfSmallPieces(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, double share);

} // namespace isopoint
