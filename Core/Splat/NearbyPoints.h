// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isopoint
{

struct NearbyPoint
{
  double squaredDistance; // in a unit of length
  std::size_t point;
};

/// The visible points around a point, nearest first. For one thread.
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
template <class TNeighbors>
class NearbyPoints
{
public:
  /// @param states of all points, or null if none is hidden
  NearbyPoints(const TNeighbors& neighbors, const SurfacePoints& points,
    const std::vector<SplatState>* states = nullptr)
    : Points(points)
    , States(states)
    , Finder(neighbors)
  {
  }

  /// Finds the points around a point. The list is empty until listWithin().
  /// @param rings see IsopointNeighbors
  /// @param unit of length; no point is listed if its inverse is not finite
  /// @param missed additional points
  void find(std::size_t point, int rings, double unit, const std::vector<std::size_t>& missed = {})
  {
    const Vector& position = this->Points.positions[point];
    const double scale = 1.0 / unit;
    this->All.clear();
    this->Nearby.clear();
    const auto addIfVisible = [&](std::size_t other)
    {
      if (!this->States || (*this->States)[other] != SplatState::Hidden)
      {
        const Vector offset = scale * (this->Points.positions[other] - position);
        this->All.push_back({ dot(offset, offset), other });
      }
    };
    for (const std::size_t other : this->Finder.find(point, rings))
    {
      addIfVisible(other);
    }
    std::for_each(missed.begin(), missed.end(), addIfVisible);
  }

  /// Lists the points at other positions within a squared distance, in squared units.
  void listWithin(double squaredLimit)
  {
    // Branch-free: writes all points and advances only past those within the limit.
    this->Nearby.resize(this->All.size());
    std::size_t count = 0;
    for (const NearbyPoint& other : this->All)
    {
      this->Nearby[count] = other;
      count += ((other.squaredDistance > 0.0) & (other.squaredDistance <= squaredLimit)) ? 1 : 0;
    }
    this->Nearby.resize(count);
    std::sort(this->Nearby.begin(), this->Nearby.end(),
      [this](const NearbyPoint& a, const NearbyPoint& b)
      {
        return a.squaredDistance != b.squaredDistance
                 ? a.squaredDistance < b.squaredDistance
                 : this->Points.numberOf(a.point) < this->Points.numberOf(b.point);
      });
  }

  auto begin() const { return this->Nearby.begin(); }
  auto end() const { return this->Nearby.end(); }
  std::size_t size() const { return this->Nearby.size(); }

private:
  const SurfacePoints& Points;
  const std::vector<SplatState>* States;
  typename TNeighbors::Finder Finder;
  std::vector<NearbyPoint> All; // unsorted
  std::vector<NearbyPoint> Nearby;
};

} // namespace isopoint
