// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_UmbrellaNormals_h
#define isopoint_UmbrellaNormals_h

#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatCell.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The normal of the plane in which the cell of a point is to be cut anew: halfway between its own
/// and that of the umbrella, the triangles between the point and its neighbors across the cell's
/// sides, if the two differ. The positions of neighbors are then more certain than the fit. See
/// docs/algorithm.md, 12.3.
/// @param normal of length 1
std::optional<Vector> turnedNormal(
  const SurfacePoints& points, std::size_t point, const Vector& normal, const SplatCell& cell);

} // namespace isopoint

#endif
