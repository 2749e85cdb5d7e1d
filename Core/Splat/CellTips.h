// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Splat/LoweredCells.h"

#include <vector>

namespace isopoint
{

/// Cuts off the corners that stick out between two points whose cells end at a border before they
/// get there. See docs/algorithm.md, section 12.6. O(points)
/// @param planes the normals of the cells' planes
/// @throws std::bad_alloc, Aborted
void cutOffTips(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, RawArray<LoweredCell>& cells);

} // namespace isopoint
