// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <vector>

namespace isopoint
{

/// Flips edges whose opposite angles add up to more than 180 degrees, so that triangles become more
/// regular: docs/triangles.md, "Regularization". Borders, edges of more than two triangles and
/// creases stay. Topology and positions stay. The result depends on the order of the triangles.
/// @param areFixed for each vertex; triangles between three fixed vertices stay
/// @param triangles ordered, before and after
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles), mostly
void flipEdges(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<char>& areFixed, std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint
