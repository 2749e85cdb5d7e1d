// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_MutualSides_h
#define isopoint_MutualSides_h

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatCell.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// A point, and one whose cell is cut halfway to it.
using MissedPoint = std::pair<std::size_t, std::size_t>;

/// The points whose cells reach over such a cut, since the other point is not among those around
/// them; ascending.
/// @param planes the normals of the cells' planes
/// @throws std::bad_alloc, Aborted
/// Complexity: O(points)
std::vector<MissedPoint> missedPoints(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, const RawArray<SplatCell>& cells);

/// A point's cell with its sides towards points whose cells have none towards it replaced by a
/// corner or, if none is close, marked as overlapping. See docs/algorithm.md, section 12.6. O(1)
SplatCell withMutualSides(const RawArray<SplatCell>& cells, std::size_t point);

} // namespace isopoint

#endif
