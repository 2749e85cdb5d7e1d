// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseSplitting_h
#define isopoint_CreaseSplitting_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Triangles/CreaseSurface.h"
#include "Isopoint/Triangles/FacetMesh.h"

#include <vector>

namespace isopoint
{

/// Gives facets vertices on the creases and at the corners between the pieces that fits have found;
/// vertices of which no piece is known are merged with neighbors. See docs/triangles.md.
/// @param whole whose vertices are appended to
/// @returns the facets, each on one piece and with the normal of that
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n)
std::vector<Facet> splitAtCreases(
  const Execution& execution, CreaseSurface& whole, std::vector<Facet> facets);

} // namespace isopoint

#endif
