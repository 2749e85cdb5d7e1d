// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TriangleGeometry_h
#define isopoint_TriangleGeometry_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Triangles/SurfaceTriangle.h"

#include <vector>

namespace isopoint
{

/// Takes back those moves of vertices by fits that would turn triangles over: if the normal of a
/// triangle of moved vertices and that of the unmoved ones form an angle of 90 degrees or more, or
/// it has no area any more, the three vertices stay, as if no fit held; until no triangle is turned
/// over. Triangles without area before are none.
/// @param unmoved positions of the vertices
/// @param fits of the vertices; those whose vertices stay have no order and that position
/// @throws std::bad_alloc, Aborted
void keepTrianglesUpright(const Execution& execution, const std::vector<Vector>& unmoved,
  const std::vector<SurfaceTriangle>& triangles, std::vector<LocalFit>& fits);

/// The normals of vertices, as splats of which nothing else is set: against the fits' gradients or,
/// without, the mean of the normals of their triangles, weighted by area.
/// @throws std::bad_alloc
std::vector<Splat> vertexNormals(
  const SurfacePoints& points, const std::vector<SurfaceTriangle>& triangles);

} // namespace isopoint

#endif
