// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatNormals_h
#define isopoint_SplatNormals_h

#include "Core/Base/Execution.h"
#include "Core/Base/SortUnique.h"
#include "Core/Base/Vector.h"
#include "Core/Splat/NearbyPoints.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// The normal against the gradient of a point's fit, if one held.
std::optional<Vector> fieldNormal(const SurfacePoints& points, std::size_t point);

/// Finds normals against the fits' gradients, if wanted and where fits held.
/// @param set(point, normal) from any thread
/// @returns the points whose normals are still to be found, ascending
/// @throws std::bad_alloc
template <class Set>
std::vector<std::size_t> setFieldNormals(
  const Execution& execution, const SurfacePoints& points, bool areOfField, const Set& set)
{
  std::vector<char> areLeft(points.positions.size(), 1);
  if (areOfField)
  {
    forEachIndex(execution, areLeft.size(),
      [&](std::size_t i)
      {
        if (const std::optional<Vector> normal = fieldNormal(points, i))
        {
          set(i, *normal);
          areLeft[i] = 0;
        }
      });
  }
  return markedOf(areLeft);
}

/// The normal of the least-squares plane through a point and others around it ([RL06] section 8),
/// turned to the side to which values decrease along the edges around; the direction of the point's
/// own edge where the points are fewer than three or collinear.
/// @param around by distance
Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around);

/// The normal of the plane through a point and the nearest ones in two rings around it. Those at
/// one position count as one. Memory is kept. For one thread.
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

#endif
