// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatCell_h
#define isopoint_SplatCell_h

#include "Core/Base/SplatNumbers.h"
#include "Core/Splat/Curvature.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// The part of a point's tangent plane that a splat covers: a convex polygon around the point, in
/// the axes of its TangentFrame and a unit of length.
struct SplatCell
{
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Whether a side faces another point.
  static bool isPoint(std::size_t beyond) { return beyond != none; }

  struct Corner
  {
    double x;
    double y;
    std::size_t beyond;    // the side that begins here: the point halfway to which it is, or none
    bool overlaps = false; // whether the cell of that point reaches over the side
  };

  const Corner* begin() const { return this->corners.data(); }
  const Corner* end() const { return this->corners.data() + this->count; }

  std::array<Corner, mostCorners> corners; // counterclockwise
  std::size_t count;                       // 0 for a hidden point
  double unit;
  PlaneForm curvature; // of the surface, in this unit; 0 where it is not known
};

} // namespace isopoint

#endif
