// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Triangles/VertexMerging.h"

#include <vector>

namespace isopoint
{

/// Gives pieces of a body's surface back their exact triangles where merging has changed the sign
/// of their volume, as it may for bodies of a few flat tetrahedra.
/// @param exact the triangles before merging
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
void restoreInvertedPieces(
  const Execution& execution, const MergeableTriangles& exact, CrossingMesh& merged);

/// Reverts the moves of vertices that turn triangles of caps over, and of pieces whose volume
/// changes its sign.
/// @param unmoved positions of the vertices
/// @param triangles of a closed surface; caps among them
/// @param fits of the vertices; reverted ones get their unmoved position and no order
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), mostly
void keepBodiesOriented(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, const std::vector<SurfaceTriangle>& caps,
  std::vector<LocalFit>& fits);

/// Gives pieces back their triangles where flips have changed the sign of their volume.
/// @param before the triangles without flips
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), mostly
void revertInvertingFlips(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& before, std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint
