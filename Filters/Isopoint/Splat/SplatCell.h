// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatCell_h
#define isopoint_SplatCell_h

#include "Isopoint/Splat/Curvature.h"
#include "Isopoint/Splat/Splat.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// The part of a point's tangent plane that a splat covers: a convex polygon around the point, in
/// the axes of its TangentFrame and a unit of length.
struct SplatCell
{
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr std::size_t overlapping = static_cast<std::size_t>(-2);

  /// Whether what is beyond a side is a point.
  static bool isPoint(std::size_t beyond) { return beyond < overlapping; }

  struct Corner
  {
    double x;
    double y;
    /// The point beyond the side that begins here, if this is a cut halfway to one; otherwise none,
    /// or overlapping if the cell of that point reaches over the side.
    std::size_t beyond;
  };

  std::array<Corner, mostCorners> corners; // counterclockwise
  std::size_t count;
  double unit;
  PlaneForm curvature; // of the surface, in this unit; 0 where it is not known
  bool isFirstHere;    // whether no earlier point is at the same position
};

} // namespace isopoint

#endif
