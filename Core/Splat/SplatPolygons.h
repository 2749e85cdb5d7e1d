// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/VoronoiCell.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The maximum number of cells whose corners are joined.
constexpr std::size_t maxMeeting = 7;

/// How many rings of points affect a splat (see SurfaceHalo, IsopointNeighbors). Up to maxMeeting
/// cells meet in a corner. The next cell is within three rings of the last one, and the cells that
/// share a side with it within one more. Tips of the last one are cut off at cells within three.
constexpr int splatRings = 4 * (static_cast<int>(maxMeeting) - 1);

/// Makes splats from cells: projects the corners onto the surface and joins those that meet; see
/// docs/algorithm.md, section 12.6. O(points)
/// @param cells of all points within splatRings of the shaped points
/// @param planes the normals of all cells' tangent planes
/// @param shaped the points whose splats are made
/// @param splats with normals; all other fields are set
/// @throws std::bad_alloc, Aborted
void shapeSplats(const Execution& execution, const SurfacePoints& points,
  RawArray<VoronoiCell> cells, const std::vector<Vector>& planes,
  const std::vector<std::size_t>& shaped, std::vector<Splat>& splats);

} // namespace isopoint
