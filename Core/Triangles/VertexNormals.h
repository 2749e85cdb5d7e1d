// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/SurfacePoints.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <vector>

namespace isopoint
{

/// The sum of the normals of the triangles at each vertex, weighted by area, in any unit.
/// @throws std::bad_alloc, Aborted
std::vector<Vector> areaNormals(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<SurfaceTriangle>& triangles, const OutgoingHalfEdges& outgoing);

/// The normals of vertices: opposite to the fits' gradients if `areOfField`, otherwise the
/// area-weighted mean of the triangle normals. The mean also replaces a missing normal, and one of
/// a failed fit, which is more than 60 degrees off both this mean and the mean of the neighbors'
/// means. Fits with creases do not fail.
/// @param isClosed whether the surface is that of a body, whose faces share vertices where it is
/// thin: where a triangle is turned away from the normal of a vertex, the mean weighted by angles
/// replaces it if none is turned farther away from that
/// @throws std::bad_alloc, Aborted
std::vector<Vector> vertexNormals(const Execution& execution, const SurfacePoints& points,
  const std::vector<SurfaceTriangle>& triangles, bool areOfField, bool isClosed);

} // namespace isopoint
