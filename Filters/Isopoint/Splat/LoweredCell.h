// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LoweredCell_h
#define isopoint_LoweredCell_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatCell.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// A SplatCell whose corners are lowered from the tangent plane onto the surface.
struct LoweredCell
{
  struct Corner
  {
    Vector position;
    Vector normal;      // of the surface, of length 1
    double distance;    // from the point, in its tangent plane
    std::size_t beyond; // see SplatCell
  };

  std::array<Corner, mostCorners> corners; // counterclockwise
  std::size_t count;
  bool isFirstHere; // see SplatCell
};

/// Lowers the corners of a point's cell onto its paraboloid; see docs/algorithm.md, section 12.6.
/// @param normal of length 1
LoweredCell loweredCell(const SplatCell& cell, const Vector& position, const Vector& normal);

} // namespace isopoint

#endif
