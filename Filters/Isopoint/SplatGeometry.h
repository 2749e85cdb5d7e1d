// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Execution.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

using Vector = std::array<double, 3>;

constexpr int defaultNeighborCount = 12;

/// A disk's normal and radius, in the units of the positions.
struct Splat
{
  Vector normal; // of length 1
  double radius; // positive
};

/// Normals and radii for the points of one surface (section 8 of the paper): the normal of the
/// least-squares plane through a point and its nearest ones, turned to the falling side, and the
/// distance of the 12th nearest, or three quarters of the edges' length around it where that is
/// more, so that neighbouring splats overlap. Points at one position
/// count as one among the nearest. Where fewer than three positions, or only collinear ones, are
/// there, the point's own edge is taken for the normal; where there is only one position, half
/// its length for the radius.
/// @param fallingEdges for each point a vector along its edge from the end that is not below the
/// isovalue to the one that is, of the edge's length
/// @param neighborCount of nearest positions the plane is fitted through, at least 3
/// @throws std::bad_alloc, Aborted; progress is told
/// Complexity: O(n log n) in all, and for each point O(neighborCount log n).
std::vector<Splat> computeSplats(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<Vector>& fallingEdges, int neighborCount);

} // namespace isopoint

#endif
