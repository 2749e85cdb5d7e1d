// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/SplatNumbers.h"
#include "Core/Splat/Curvature.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// The Voronoi cell of a point, restricted to its tangent plane and limited: a convex polygon
/// around the point, in the axes of its TangentFrame and a unit of length.
struct VoronoiCell
{
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  static bool isPoint(std::size_t beyond) { return beyond != none; }

  struct Corner
  {
    double x;
    double y;
    std::size_t beyond;    // the point beyond the side that begins here, or none
    bool overlaps = false; // whether the cell of that point extends over the side
  };

  const Corner* begin() const { return this->corners.data(); }
  const Corner* end() const { return this->corners.data() + this->count; }

  std::array<Corner, mostCorners> corners; // counterclockwise
  std::size_t count;                       // 0 for a hidden point
  double unit;
  PlaneForm curvature; // of the surface, in this unit; 0 if unknown
};

} // namespace isopoint
