// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/SplatNumbers.h"
#include "Core/Splat/Curvature.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// The index of the next corner of a cell, or of the previous one; a remainder would take longer.
/// @tparam TCell has the corners and count of a VoronoiCell
template <class TCell>
std::size_t cornerAfter(const TCell& cell, std::size_t corner)
{
  return corner + 1 < cell.count ? corner + 1 : 0;
}
template <class TCell>
std::size_t cornerBefore(const TCell& cell, std::size_t corner)
{
  return (corner > 0 ? corner : cell.count) - 1;
}

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

  /// The corner where the side before a side begins, and the one where the side after it does.
  const Corner& before(std::size_t side) const { return this->corners[cornerBefore(*this, side)]; }
  const Corner& after(std::size_t side) const { return this->corners[cornerAfter(*this, side)]; }

  const Corner* begin() const { return this->corners.data(); }
  const Corner* end() const { return this->corners.data() + this->count; }

  std::array<Corner, maxCorners> corners; // counterclockwise
  std::size_t count;                      // 0 for a hidden point
  double unit;
  PlaneForm curvature; // of the surface, in this unit; 0 if unknown
};

/// The index of a cell's side towards a point, or cell.count if there is none.
/// @tparam TCell has the corners and count of a VoronoiCell
template <class TCell>
std::size_t sideTowards(const TCell& cell, std::size_t point)
{
  std::size_t side = 0;
  while (side < cell.count && cell.corners[side].beyond != point)
  {
    ++side;
  }
  return side;
}

} // namespace isopoint
