// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/SplatNumbers.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/SurfacePoints.h"

#include <cstdint>

namespace isopoint
{

enum class SplatState : char
{
  Undecided,
  Visible,
  Hidden // a visible point represents it
};

/// Counts the inner corners of a splat: those between two sides that have a neighbor.
struct SplatCornerCounts
{
  std::uint32_t inner = 0;
  std::uint32_t apart = 0; // of these, corners that meet no others: there may be a hole
};

/// The surfel of a point: the triangles between the point and each two consecutive corners.
struct Splat
{
  Vector normal; // of length 1
  double radius; // the distance of the farthest corner
  Vector axis;   // t1, tangential and as long as the radius; t2 = normal x t1
  /// Counterclockwise around the normal; in rare cases, joining has moved corners past each other.
  /// Unused corners repeat the last one; all are 0 at a hidden point.
  SplatCorners corners;
  SplatCornerCounts counts;
};

constexpr int defaultNeighborCount = 12;

struct SplatOptions
{
  int neighborCount = defaultNeighborCount; // nearest positions used to fit a plane, 3 or more
  bool fieldNormals = true;                 // use the gradients of the fits, where available
  bool shapes = true;                       // or only normals: all other fields are 0
};

} // namespace isopoint
