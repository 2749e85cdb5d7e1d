// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Thinning_h
#define isopoint_Thinning_h

#include "Core/Base/Execution.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Fit/LocalFit.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Drops isopoints where they are denser than the samples warrant: of the surface's points in their
/// order, each is kept unless it is close to one that was kept before.
///
/// With the reach r = minimumSpacing * (the smaller of the two spacings), two points are close if a
/// fit held around both, they are less than r apart, neither stands more than r / 4 off the tangent
/// plane of the other, and the cosine between the gradients, which both are finite and not 0, is at
/// least `mostCreaseCosine`. So points on two sheets, or on either side of a crease, are never
/// close: consecutive sheets of one isovalue have opposite gradients, and the next but one lies off
/// the tangent plane. Around points with spacings beyond 1e290 nothing is close.
/// @param surface with fits, or nothing is dropped; its coincident samples remain, those at edges
/// that are dropped included
/// @param minimumSpacing 0, which drops nothing, up to 1
/// @throws std::bad_alloc or Aborted, the surface then unchanged
/// Complexity: O(n) for each power of two between the smallest and the largest spacing
void thin(const Execution& execution, double minimumSpacing, Isosurface& surface);

/// Which isopoints thin() keeps, ascending.
/// @param fits of all, in the surface's order
/// @param minimumSpacing above 0
std::vector<std::size_t> keptPoints(
  const Execution& execution, double minimumSpacing, const std::vector<LocalFit>& fits);

} // namespace isopoint

#endif
