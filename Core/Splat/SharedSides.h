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

/// Two points. The cell of the second ends halfway to the first.
using MissedPoint = std::pair<std::size_t, std::size_t>;

/// Pairs whose cells overlap: the cell of the first does not end halfway to the second, because the
/// second was not among its neighbors. Ascending. O(points)
/// @param planes the normals of the cells' planes
/// @throws std::bad_alloc, Aborted
std::vector<MissedPoint> missedPoints(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, const RawArray<VoronoiCell>& cells);

/// A point's cell with every side that is not shared replaced by a corner or, if no corner is
/// close, marked as overlapping. See docs/algorithm.md, section 12.6. O(1)
VoronoiCell withSharedSides(const RawArray<VoronoiCell>& cells, std::size_t point);

} // namespace isopoint
