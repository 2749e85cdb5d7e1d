// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatFans_h
#define isopoint_SplatFans_h

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatCell.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// How many corners of cells are brought together, at most.
constexpr std::size_t mostMeeting = 6;

/// How far away points matter for a splat, in rings of a SurfaceHalo: of cells that meet each is in
/// the third ring of the next (see IsopointNeighbors), and so are those that share their sides.
constexpr int fanRings = 4 * static_cast<int>(mostMeeting);

/// Makes splats of cells: lowers the cells' corners onto the surface, and brings those together
/// that meet; see docs/algorithm.md, section 12.6. O(points)
/// @param cells of all points within fanRings of those that are shaped
/// @param planes the normals of the tangent planes of all cells
/// @param shaped the points whose splats are made
/// @param splats of which normals are set; all else is set here
/// @throws std::bad_alloc, Aborted
void shapeSplats(const Execution& execution, const SurfacePoints& points, RawArray<SplatCell> cells,
  const std::vector<Vector>& planes, const std::vector<std::size_t>& shaped,
  std::vector<Splat>& splats);

} // namespace isopoint

#endif
