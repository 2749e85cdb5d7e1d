// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatNormals_h
#define isopoint_SplatNormals_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/Splat.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Sets normals against the fits' gradients, where fits held and options.fieldNormals is set.
/// @returns the points whose normals are still to be found
std::vector<std::size_t> setFieldNormals(
  const SurfacePoints& points, const SplatOptions& options, std::vector<Splat>& splats);

/// The normal of the least-squares plane through a point and others around it ([RL06] section 8),
/// turned to the side to which values decrease along the edges around; the direction of the point's
/// own edge where the points are fewer than three or collinear.
/// @param around by distance
Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around);

} // namespace isopoint

#endif
