// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_EdgeFlipping_h
#define isopoint_EdgeFlipping_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Flips edges of a surface whose two opposite angles add up to more than 180 degrees, so that
/// triangles become more regular: docs/triangles.md, "Regularization". Edges of borders, of more
/// than two triangles and across creases stay, and so do topology and positions. The result depends
/// on the order of the triangles.
/// @param areKept of each vertex: triangles between three of these stay
/// @param triangles ordered, before and after
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles), mostly
void flipEdges(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<char>& areKept, std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint

#endif
