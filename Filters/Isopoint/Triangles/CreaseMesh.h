// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseMesh_h
#define isopoint_CreaseMesh_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Triangles/SurfaceTriangle.h"

#include <vector>

namespace isopoint
{

/// Gives a surface the sharp edges and corners that fits with creases have found, in the way of
/// extended marching cubes [KBSS01]: edges between vertices on different pieces get a vertex on the
/// crease, triangles on three pieces one at the corner. Vertices beside creases at which no fit
/// holds are merged with a neighbor, and edges are flipped where triangles look the wrong way; a
/// closed surface stays closed. See docs/triangles.md.
/// @param surface with fits; new vertices are appended, and take over the edge of the first vertex
/// of theirs; vertices without triangles are dropped
/// @param triangles of its vertices, ordered
/// @param parts whether vertices are repeated for each piece that they are on
/// @throws std::bad_alloc, Aborted
/// Complexity: O(triangles), and O(n log n) of those beside creases
void meshCreases(const Execution& execution, Isosurface& surface,
  std::vector<SurfaceTriangle>& triangles, bool parts);

} // namespace isopoint

#endif
