// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Tetrahedra/PartialTriangulation.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// A facet at the border of a body: between a tetrahedron of the body and a gap or the outside. At
/// least one corner is not below the isovalue.
struct CapFacet : FacetCorners
{
  /// Per side, from a corner to the next: the cap facet that is met by turning around this side
  /// through the body. Undefined for a side with both ends below.
  std::array<std::size_t, 3> partners;
};

} // namespace isopoint
