// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatNormals_h
#define isopoint_SplatNormals_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/NearbyPoints.h"
#include "Isopoint/Splat/Splat.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// Sets normals against the fits' gradients, where fits held and options.fieldNormals is set.
/// @returns the points whose normals are still to be found
std::vector<std::size_t> setFieldNormals(
  const SurfacePoints& points, const SplatOptions& options, std::vector<Splat>& splats);

/// The normal of the least-squares plane through a point and others around it ([RL06] section 8),
/// turned to the side to which values decrease along the edges around; the direction of the point's
/// own edge where the points are fewer than three or collinear.
/// @param around by distance
Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around);

/// The normal of the plane through a point and the nearest ones in two rings around it. Memory is
/// kept. For one thread.
/// @tparam TNeighbors see NearbyPoints
template <class TNeighbors>
class PlaneNormals
{
public:
  /// @param count of the nearest
  PlaneNormals(const TNeighbors& neighbors, const SurfacePoints& points, int count)
    : Points(points)
    , Nearby(neighbors, points)
    , Count(static_cast<std::size_t>(count))
  {
  }

  Vector at(std::size_t point)
  {
    this->Nearby.find(point, 2, lengthOf(this->Points.decreasingEdges[point]));
    this->Nearby.listWithin(std::numeric_limits<double>::max());
    this->Around.clear();
    for (const NearbyPoint& other : this->Nearby)
    {
      if (this->Around.size() < this->Count)
      {
        this->Around.push_back(other.point);
      }
    }
    return planeNormal(this->Points, point, this->Around);
  }

private:
  const SurfacePoints& Points;
  NearbyPoints<TNeighbors> Nearby;
  std::size_t Count;
  std::vector<std::size_t> Around;
};

} // namespace isopoint

#endif
