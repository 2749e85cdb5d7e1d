// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The connected components of a surface, its *pieces*. Each is named by its lowest vertex.
struct SurfacePieces
{
  /// O(vertices + triangles), mostly @throws std::bad_alloc, Aborted
  SurfacePieces(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
    std::size_t vertexCount);

  std::vector<std::size_t> pieceOf; // by vertex
};

/// The volumes within closed pieces, positive if their normals point outwards. By piece, 0 for
/// other vertices. @throws std::bad_alloc, Aborted
std::vector<double> volumesOf(const Execution& execution, const SurfacePieces& pieces,
  const std::vector<Vector>& positions, const std::vector<SurfaceTriangle>& triangles);

/// Marks the triangles of small pieces. In bodies, which are closed, bubbles, with a negative
/// volume, are marked only if they are within a marked piece.
/// @param share of the largest piece's area, below which a piece is small
/// @returns by triangle
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), and O(n) for each bubble near a marked piece
std::vector<char> areOfSmallPieces(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, double share, bool areBodies);

} // namespace isopoint
