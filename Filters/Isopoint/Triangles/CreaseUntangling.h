// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CreaseUntangling_h
#define isopoint_CreaseUntangling_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Triangles/CreaseSurface.h"
#include "Isopoint/Triangles/FacetMesh.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Makes facets look to the side of their normals: flips edges, and merges or moves vertices where
/// that does not suffice. A few may be left.
/// @param whole whose vertices on creases may be moved along them
/// @param firstOnCrease the first vertex on a crease, all others being behind it
/// @throws std::bad_alloc, Aborted
std::vector<Facet> untangleFacets(const Execution& execution, CreaseSurface& whole,
  std::vector<Facet> facets, std::size_t firstOnCrease);

} // namespace isopoint

#endif
