// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Hash.h"
#include "Core/Base/Vector.h"
#include "Core/Splat/Splat.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <vector>

namespace isopoint
{

/// Finds points that need no splat: those at the position of a visible point, or very close to one
/// on the same sheet. If many samples have exactly the isovalue, all edges that end at such a
/// sample yield nearly the same point, and they differ only by rounding. For one thread.
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

  /// The next state of an undecided point: hidden if next to a visible point, visible if first
  /// among the undecided points next to it.
  /// @param states of all points
  SplatState next(std::size_t point, const std::vector<SplatState>& states)
  {
    bool isFirst = true;
    for (const std::size_t other : this->Finder.find(point, 1))
    {
      if (other != point && states[other] != SplatState::Hidden &&
          this->areDuplicates(point, other))
      {
        if (states[other] == SplatState::Visible)
        {
          return SplatState::Hidden;
        }
        isFirst = isFirst && this->keyOf(point) < this->keyOf(other);
      }
    }
    return isFirst ? SplatState::Visible : SplatState::Undecided;
  }

private:
  bool areDuplicates(std::size_t point, std::size_t other) const
  {
    constexpr double closeness = 0.05; // in units of length
    constexpr double minCosine = 0.7;
    if (this->Points.positions[point] == this->Points.positions[other])
    {
      return true;
    }
    const Vector offset = this->Points.positions[other] - this->Points.positions[point];
    const double unit = unitAt(this->Points, point);
    // Most are farther by one coordinate alone, which takes neither a square root nor another fit.
    return std::all_of(offset.begin(), offset.end(),
             [unit](double component) { return std::abs(component) < closeness * unit; }) &&
           lengthOf(offset) < closeness * std::min(unit, unitAt(this->Points, other)) &&
           dot(this->Normals[point], this->Normals[other]) > minCosine;
  }

  /// A pseudorandom order of close points, so that chains of them are decided in few rounds. It
  /// depends neither on the order of the samples nor on scaling by a power of two.
  std::tuple<std::uint64_t, Vector, Vector, std::size_t> keyOf(std::size_t point) const
  {
    const Vector& position = this->Points.positions[point];
    std::uint64_t hash = 0;
    for (const double coordinate : position)
    {
      int exponent = 0;
      // In float, so that rounding of coordinates hardly matters; + 0.0f makes -0 equal to 0.
      const auto mantissa = static_cast<float>(std::frexp(coordinate, &exponent)) + 0.0f;
      std::uint32_t bits = 0;
      std::memcpy(&bits, &mantissa, sizeof(bits));
      hash = extendedHash(hash, bits);
    }
    return { hash, position, this->Points.decreasingEdges[point], this->Points.numberOf(point) };
  }

  const SurfacePoints& Points;
  const std::vector<Vector>& Normals;
  typename TNeighbors::Finder Finder;
};

} // namespace isopoint
