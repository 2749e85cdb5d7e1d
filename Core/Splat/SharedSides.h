// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/VoronoiCell.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// A point, and another point whose cell is cut halfway to it.
using MissedPoint = std::pair<std::size_t, std::size_t>;

/// Pairs in which the first point's cell extends over the cut halfway to the other, because its
/// neighborhood lacks the other. Ascending. O(points)
/// @param planes the normals of the cells' planes
/// @throws std::bad_alloc, Aborted
std::vector<MissedPoint> missedPoints(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, const RawArray<VoronoiCell>& cells);

/// A point's cell with every side that is not shared replaced by a corner or, if no corner is
/// close, marked as overlapping. See docs/algorithm.md, section 12.6. O(1)
VoronoiCell withSharedSides(const RawArray<VoronoiCell>& cells, std::size_t point);

} // namespace isopoint
