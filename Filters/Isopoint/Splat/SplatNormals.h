// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatNormals_h
#define isopoint_SplatNormals_h

#include "Isopoint/Splat/NearestPositions.h"
#include "Isopoint/Base/Vector.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Normals from planes through the nearest points, one at a time. For one thread.
class PlaneNormals
{
public:
  /// @param decreasingEdges along each point's edge, from the end that is not below the isovalue
  /// @param neighborCount how many of the nearest points a plane is fitted through
  PlaneNormals(const NearestPositions& nearest, const std::vector<Vector>& positions,
    const std::vector<Vector>& decreasingEdges, std::size_t neighborCount);

  /// The normal of the least-squares plane through a point and its nearest ones (section 8 of the
  /// paper), turned to the side to which edges around fall; the direction of the point's own edge
  /// where those are fewer than three or collinear.
  /// Complexity: O(neighborCount log n)
  Vector at(std::size_t point);

private:
  Vector fitPlane(std::size_t point);
  Vector decreasingSide(const Vector& own) const;

  const NearestPositions& Finder;
  const std::vector<Vector>& Positions;
  const std::vector<Vector>& DecreasingEdges;
  const std::size_t NeighborCount;
  std::vector<NearestPositions::Neighbor> Nearest;
};

} // namespace isopoint

#endif
