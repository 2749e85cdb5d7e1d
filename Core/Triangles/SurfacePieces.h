// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The connected components of a surface, its *pieces*, by vertex. Each is named by its lowest
/// vertex. O(vertices + triangles), mostly @throws std::bad_alloc, Aborted
std::vector<std::size_t> piecesOf(const Execution& execution,
  const std::vector<SurfaceTriangle>& triangles, std::size_t vertexCount);

/// The volumes within closed pieces, positive if their normals point outwards. By piece, 0 for
/// other vertices. @throws std::bad_alloc, Aborted
/// @param pieces piecesOf()
std::vector<double> volumesOf(const Execution& execution, const std::vector<std::size_t>& pieces,
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
