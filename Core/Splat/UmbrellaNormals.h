// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/VoronoiCell.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The normal of a turned plane in which a point's cell should be cut again: halfway between the
/// given normal and that of the umbrella, the triangles between the point and the neighbors of its
/// cell. Nothing if the two agree. If they differ, the neighbors' positions are more reliable than
/// the fit. See docs/algorithm.md, section 12.3.
/// @param normal of length 1
std::optional<Vector> turnedNormal(
  const SurfacePoints& points, std::size_t point, const Vector& normal, const VoronoiCell& cell);

} // namespace isopoint
