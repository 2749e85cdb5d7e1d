// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Fit/LocalFit.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Drops isopoints that are denser than the samples warrant: in the surface's order, each is kept
/// unless it is close to one already kept.
/// With r = minimumSpacing * (smaller of the two spacings), two points are close if both have a
/// fit, their distance is less than r, neither is more than r / 4 off the other's tangent plane,
/// both gradients are finite and nonzero, and the cosine between them is at least
/// `maxCreaseCosine`. So points on two sheets or on both sides of a crease are never close:
/// consecutive sheets of one isovalue have opposite gradients, and the next but one is off the
/// tangent plane. Points with spacings over 1e290 are not close to any.
/// @param surface without coincident samples; nothing is dropped without fits
/// @param minimumSpacing from 0, which drops nothing, to 1
/// @throws std::bad_alloc or Aborted, the surface unchanged
/// Complexity: O(n) for each power of two between the smallest and the largest spacing
void thin(const Execution& execution, double minimumSpacing, Isosurface& surface);

/// The isopoints that thin() keeps, ascending.
/// @param fits of all, in the surface's order
/// @param minimumSpacing above 0
std::vector<std::size_t> keptPoints(
  const Execution& execution, double minimumSpacing, const std::vector<LocalFit>& fits);

} // namespace isopoint
