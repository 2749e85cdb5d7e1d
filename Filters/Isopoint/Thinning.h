// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Thinning_h
#define isopoint_Thinning_h

#include "Execution.h"
#include "Isopoint.h"
#include "LocalFit.h"

namespace isopoint
{

/// Whether fits tell that two isopoints of one surface stand closer to each other than they need
/// to. With the reach r = minimumSpacing * (the smaller of the two spacings) they do if a fit held
/// around both, they are less than r apart, neither stands more than r / 4 off the tangent plane of
/// the other, and the gradients, which both are finite and not 0, lie within the angle of
/// `mostCreaseCosine` of each other. So points on two sheets, or on either side of a crease, are
/// never close: consecutive sheets of one isovalue have opposite gradients, and the next but one
/// lies off the tangent plane. Spacings beyond 1e290 are too large for anything to be close.
/// @param minimumSpacing 0 up to 1
bool areClose(const LocalFit& one, const LocalFit& other, double minimumSpacing);

/// Drops isopoints where they are denser than they need to be: of the surface's points in their
/// order each is kept if it is not close (see areClose) to one that was kept before.
/// @param surface with fits, or nothing is dropped; of its merged samples those stay that its
/// points end at
/// @param minimumSpacing 0, which drops nothing, up to 1
/// @throws std::bad_alloc or Aborted, the surface then unchanged
/// Complexity: O(n log n), and O(n) for each power of two between the smallest and the largest
/// spacing
void thin(const Execution& execution, double minimumSpacing, Isosurface& surface);

} // namespace isopoint

#endif
