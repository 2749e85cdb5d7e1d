// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatNormals_h
#define isopoint_SplatNormals_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/NearestPositions.h"
#include "Isopoint/Splat/Splat.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// Sets normals against the fits' gradients, where fits held and options.fieldNormals is set.
/// @returns the points whose normals are still to be found
std::vector<std::size_t> setFieldNormals(
  const SurfacePoints& points, const SplatOptions& options, std::vector<Splat>& splats);

/// Normals from planes through the nearest points, one at a time. For one thread.
class PlaneNormals
{
public:
  /// @param decreasingEdges see Isosurface
  /// @param neighborCount how many of the nearest points a plane is fitted through
  PlaneNormals(const NearestPositions& nearest, const std::vector<Vector>& positions,
    const std::vector<Vector>& decreasingEdges, std::size_t neighborCount);

  /// The normal of the least-squares plane through a point and its nearest ones ([RL06] section 8),
  /// turned to the side to which values decrease along the edges around; the direction of the
  /// point's own edge where the points are fewer than three or collinear.
  /// Complexity: O(neighborCount log n)
  Vector at(std::size_t point);

private:
  std::optional<Vector> fitPlane(std::size_t point) const;
  Vector decreasingSide(const Vector& own) const;

  const NearestPositions& Finder;
  const std::vector<Vector>& Positions;
  const std::vector<Vector>& DecreasingEdges;
  const std::size_t NeighborCount;
  std::vector<NearestPositions::Neighbor> Nearest;
};

} // namespace isopoint

#endif
