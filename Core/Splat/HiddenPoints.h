// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_HiddenPoints_h
#define isopoint_HiddenPoints_h

#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Finds points without a splat of their own, since another one represents them: one of a lower
/// number in the first ring that is at the same position, or very close to it on the same sheet.
/// Where many samples have the isovalue itself, all edges that end in one of them yield nearly the
/// same point, and what separates these is rounding. For one thread.
/// @tparam TNeighbors see NearbyPoints
template <class TNeighbors>
class HiddenPoints
{
public:
  HiddenPoints(
    const TNeighbors& neighbors, const SurfacePoints& points, const std::vector<Vector>& normals)
    : Points(points)
    , Normals(normals)
    , Finder(neighbors)
  {
  }

  bool has(std::size_t point)
  {
    const auto around = this->Finder.find(point, 1);
    return std::any_of(around.begin(), around.end(),
      [&](std::size_t other)
      {
        return this->Points.numberOf(other) < this->Points.numberOf(point) &&
               this->areOne(point, other);
      });
  }

private:
  bool areOne(std::size_t point, std::size_t other) const
  {
    constexpr double closeness = 0.05; // in units of length
    constexpr double leastCosine = 0.7;
    const Vector offset = difference(this->Points.positions[other], this->Points.positions[point]);
    const double reach =
      closeness * std::min(unitAt(this->Points, point), unitAt(this->Points, other));
    return this->Points.positions[point] == this->Points.positions[other] ||
           (dot(offset, offset) < reach * reach &&
             dot(this->Normals[point], this->Normals[other]) > leastCosine);
  }

  const SurfacePoints& Points;
  const std::vector<Vector>& Normals;
  typename TNeighbors::Finder Finder;
};

} // namespace isopoint

#endif
