// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Splat/NearbyPoints.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// The normal of the least-squares plane through a point and its neighbors ([RL06] section 8),
/// oriented along the edges around towards decreasing values. With fewer than three points, or
/// collinear ones, the direction of the point's own edge.
/// @param around by distance
Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around);

/// Computes normals of planes through a point and its nearest points within two rings. Points at
/// the same position count once. Reuses memory. For one thread.
/// @tparam TNeighbors see NearbyPoints
template <class TNeighbors>
class PlaneNormals
{
public:
  /// @param count of nearest points
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
    for (auto other = this->Nearby.begin();
         other != this->Nearby.end() && this->Around.size() < this->Count; ++other)
    {
      if (!this->hasPosition(this->Points.positions[other->point]))
      {
        this->Around.push_back(other->point);
      }
    }
    return planeNormal(this->Points, point, this->Around);
  }

private:
  bool hasPosition(const Vector& position) const
  {
    return std::any_of(this->Around.begin(), this->Around.end(),
      [&](std::size_t other) { return this->Points.positions[other] == position; });
  }

  const SurfacePoints& Points;
  NearbyPoints<TNeighbors> Nearby;
  std::size_t Count;
  std::vector<std::size_t> Around;
};

} // namespace isopoint
