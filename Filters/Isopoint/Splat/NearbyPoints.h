// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NearbyPoints_h
#define isopoint_NearbyPoints_h

#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace isopoint
{

/// A point near another one.
struct NearbyPoint
{
  double squaredDistance; // in a unit of length
  std::size_t point;
};

/// The points around each point, nearest first. Those at one position count as one, the first. For
/// one thread.
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
template <class TNeighbors>
class NearbyPoints
{
public:
  NearbyPoints(const TNeighbors& neighbors, const std::vector<Vector>& positions)
    : Positions(positions)
    , Finder(neighbors)
  {
  }

  /// Goes to a point.
  /// @param rings see IsopointNeighbors
  /// @param unit of length; if one over it is not finite, nothing is found
  /// @param squaredLimit of the distances, in this unit
  void find(std::size_t point, int rings, double unit,
    double squaredLimit = std::numeric_limits<double>::max())
  {
    this->Finder.find(point, rings, this->Found);
    this->keepWithin(point, unit, squaredLimit);
  }

  /// Lists those found around the point within another limit.
  void keepWithin(std::size_t point, double unit, double squaredLimit)
  {
    const Vector& position = this->Positions[point];
    const double scale = 1.0 / unit;
    // Which ones are within the limit is unpredictable: all are written, and those are kept.
    this->Nearby.resize(this->Found.size());
    std::size_t count = 0;
    this->IsFirstHere = true;
    for (const std::size_t other : this->Found)
    {
      const Vector offset = scaled(scale, difference(this->Positions[other], position));
      const double squaredDistance = dot(offset, offset);
      this->Nearby[count] = { squaredDistance, other };
      this->IsFirstHere &= (squaredDistance != 0.0) | (other >= point);
      count += ((squaredDistance > 0.0) & (squaredDistance <= squaredLimit)) ? 1 : 0;
    }
    this->Nearby.resize(count);
    std::sort(this->Nearby.begin(), this->Nearby.end(),
      [](const NearbyPoint& a, const NearbyPoint& b)
      {
        return a.squaredDistance != b.squaredDistance ? a.squaredDistance < b.squaredDistance
                                                      : a.point < b.point;
      });
    this->dropCoincident();
  }

  /// Lists the nearest ones around a point, in one ring or, if these are too few, in two.
  void nearest(std::size_t point, double unit, std::size_t count, std::vector<std::size_t>& found)
  {
    for (int rings = 1; rings <= 2 && (rings == 1 || this->size() < count); ++rings)
    {
      this->find(point, rings, unit);
    }
    found.clear();
    for (std::size_t i = 0; i < std::min(count, this->size()); ++i)
    {
      found.push_back(this->Nearby[i].point);
    }
  }

  /// Whether no earlier point found is at the same position.
  bool isFirstHere() const { return this->IsFirstHere; }

  auto begin() const { return this->Nearby.begin(); }
  auto end() const { return this->Nearby.end(); }
  std::size_t size() const { return this->Nearby.size(); }

private:
  void dropCoincident()
  {
    std::size_t count = 0;
    for (const NearbyPoint& nearby : this->Nearby)
    {
      std::size_t i = count;
      while (i > 0 && this->Nearby[i - 1].squaredDistance == nearby.squaredDistance &&
             this->Positions[this->Nearby[i - 1].point] != this->Positions[nearby.point])
      {
        --i;
      }
      if (i == 0 || this->Nearby[i - 1].squaredDistance != nearby.squaredDistance)
      {
        this->Nearby[count++] = nearby;
      }
    }
    this->Nearby.resize(count);
  }

  const std::vector<Vector>& Positions;
  typename TNeighbors::Finder Finder;
  std::vector<std::size_t> Found;
  std::vector<NearbyPoint> Nearby;
  bool IsFirstHere = true;
};

} // namespace isopoint

#endif
