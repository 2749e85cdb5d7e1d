// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <vector>

namespace isopoint
{

/// Reverts moves longer than twice the longest edge of the vertex's triangles, and then moves that
/// invert triangles, until none does. A move inverts a triangle if the triangle's normal agrees
/// with the negated sum of its vertices' gradient directions before the move, but not after it. Its
/// three vertices then stay, as if no fit held. (In flat tetrahedra, linear interpolation alone
/// leaves some inverted triangles.) Vertices of fits with creases, and their triangles, are left to
/// meshCreases().
/// @param unmoved positions of the vertices
/// @param fits of the vertices; reverted ones get their unmoved position and no order
/// @throws std::bad_alloc, Aborted
/// Complexity: O(vertices + triangles), or O(n log n) if many are inverted, in all rounds
void keepTrianglesUpright(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, std::vector<LocalFit>& fits);

} // namespace isopoint
