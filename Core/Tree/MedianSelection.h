// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// The coordinates on both sides of a cut through sorted coordinates. At the median of a node,
/// their ranks are count / 2 - 1 and count / 2.
template <class TCoordinate>
struct MiddleCoordinates
{
  TCoordinate last;  // of the lower half
  TCoordinate first; // of the upper half
};

/// The coordinates of rank - 1 and rank, 0 < rank < count. Counts the smaller coordinates of each:
/// count^2 comparisons, but vectorized and without branches.
template <class TCoordinate>
MiddleCoordinates<TCoordinate> selectByCounting(
  const TCoordinate* coordinates, std::size_t count, std::size_t rank)
{
  TCoordinate last = -std::numeric_limits<TCoordinate>::infinity();
  TCoordinate first = std::numeric_limits<TCoordinate>::infinity();
  for (std::size_t i = 0; i < count; ++i)
  {
    const TCoordinate coordinate = coordinates[i];
    std::int32_t smaller = 0;
    for (std::size_t j = 0; j < count; ++j)
    {
      smaller += coordinates[j] < coordinate ? 1 : 0;
    }
    // Equal coordinates occupy consecutive ranks from `smaller` on. `last` is the greatest
    // coordinate that has a rank below `rank`; the number of coordinates up to it decides `first`.
    last = static_cast<std::size_t>(smaller) < rank ? std::max(last, coordinate) : last;
    first = static_cast<std::size_t>(smaller) >= rank ? std::min(first, coordinate) : first;
  }
  std::size_t upToLast = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    upToLast += coordinates[i] <= last ? 1 : 0;
  }
  return { last, upToLast > rank ? last : first };
}

/// Vectorized passes over coordinates: each lane of a block has its own sums and extrema.
template <class TCoordinate>
class CoordinatePasses
{
public:
  struct Range
  {
    TCoordinate least;
    TCoordinate greatest;
  };

  /// Coordinates on both sides of a pivot, which is not greater than all of them.
  struct Division
  {
    std::size_t below; // number less than the pivot
    TCoordinate last;  // the greatest of these, if any
    TCoordinate first; // the least of the others
  };

  /// @param coordinates finite
  /// @param count at least 1; elements after the first `count` are overwritten
  CoordinatePasses(std::vector<TCoordinate>& coordinates, std::size_t count)
    : PaddedCount((count + lanes - 1) / lanes * lanes)
  {
    coordinates.resize(std::max(coordinates.size(), this->PaddedCount));
    this->Coordinates = coordinates.data();
    std::fill(this->Coordinates + count, this->Coordinates + this->PaddedCount, infinity);
  }

  const TCoordinate& operator[](std::size_t i) const { return this->Coordinates[i]; }

  Range range() const
  {
    TCoordinate least[lanes];
    TCoordinate greatest[lanes];
    std::fill_n(least, lanes, infinity);
    std::fill_n(greatest, lanes, -infinity);
    for (std::size_t block = 0; block < this->PaddedCount; block += lanes)
    {
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        const TCoordinate coordinate = this->Coordinates[block + lane];
        const TCoordinate finite = coordinate < infinity ? coordinate : -infinity;
        least[lane] = coordinate < least[lane] ? coordinate : least[lane];
        greatest[lane] = finite > greatest[lane] ? finite : greatest[lane];
      }
    }
    return { *std::min_element(least, least + lanes),
      *std::max_element(greatest, greatest + lanes) };
  }

  Division divide(TCoordinate pivot) const
  {
    Counter below[lanes];
    TCoordinate last[lanes];
    TCoordinate first[lanes];
    std::fill_n(below, lanes, 0);
    std::fill_n(last, lanes, -infinity);
    std::fill_n(first, lanes, infinity);
    for (std::size_t block = 0; block < this->PaddedCount; block += lanes)
    {
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        const TCoordinate coordinate = this->Coordinates[block + lane];
        const bool isBelow = coordinate < pivot;
        const TCoordinate lower = isBelow ? coordinate : -infinity;
        const TCoordinate upper = isBelow ? infinity : coordinate;
        below[lane] += isBelow ? 1 : 0;
        last[lane] = lower > last[lane] ? lower : last[lane];
        first[lane] = upper < first[lane] ? upper : first[lane];
      }
    }
    Division division{ 0, *std::max_element(last, last + lanes),
      *std::min_element(first, first + lanes) };
    for (const Counter belowInLane : below)
    {
      division.below += static_cast<std::size_t>(belowInLane);
    }
    return division;
  }

private:
  // As wide as a coordinate, so that both fill the same vectors. 32 bits suffice for float
  // coordinates, of which there are fewer than 2^30.
  using Counter =
    std::conditional_t<sizeof(TCoordinate) <= sizeof(std::int32_t), std::int32_t, std::int64_t>;

  static constexpr std::size_t lanes = 8;
  static constexpr TCoordinate infinity = std::numeric_limits<TCoordinate>::infinity();

  TCoordinate* Coordinates;
  std::size_t PaddedCount;
};

/// The coordinates of rank - 1 and rank, 0 < rank < count. O(count). Pivots are interpolated
/// between the nearest known coordinates: a uniform distribution takes three or four passes. If
/// this converges slowly, every other pivot is one of the coordinates in between.
/// @param coordinates the first `count` are finite, and may be reordered; others may be overwritten
template <class TCoordinate>
MiddleCoordinates<TCoordinate> selectMiddle(
  std::vector<TCoordinate>& coordinates, std::size_t count, std::size_t rank)
{
  constexpr std::size_t countingLimit = 8;
  constexpr int interpolations = 4;
  constexpr int maxPasses = 40;
  if (count <= countingLimit)
  {
    return selectByCounting(coordinates.data(), count, rank);
  }
  const CoordinatePasses<TCoordinate> passes(coordinates, count);
  const auto range = passes.range();
  TCoordinate lower = range.least; // lower <= last and first <= upper
  TCoordinate upper = range.greatest;
  std::size_t below = 0;    // coordinates less than `lower`
  std::size_t upTo = count; // coordinates not greater than `upper`
  std::size_t next = 0;
  for (int pass = 0; pass < maxPasses; ++pass)
  {
    if (lower == upper)
    {
      return { lower, upper };
    }
    const auto share =
      static_cast<TCoordinate>(rank - below) / static_cast<TCoordinate>(upTo - below);
    TCoordinate pivot = lower + share * (upper - lower);
    if (pass >= interpolations && pass % 2 != 0)
    {
      while (!(passes[next] > lower && passes[next] <= upper))
      {
        next = (next + 1) % count;
      }
      pivot = passes[next];
    }
    pivot = pivot > lower && pivot <= upper ? pivot : upper;
    const auto division = passes.divide(pivot);
    if (division.below == rank)
    {
      return { division.last, division.first };
    }
    if (division.below < rank)
    {
      lower = division.first;
      below = division.below;
    }
    else
    {
      upper = division.last;
      upTo = division.below;
    }
  }
  const auto begin = coordinates.begin();
  const auto first = begin + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(begin, first, begin + static_cast<std::ptrdiff_t>(count));
  return { *std::max_element(begin, first), *first };
}

/// Bounds that very likely enclose both middle coordinates and few others, from a random subset
/// [FR75]. The seed is the count, so runs are reproducible.
template <class TSample>
struct MiddleBracket
{
  using Coordinate = typename TSample::Coordinate;
  Coordinate lower = -std::numeric_limits<Coordinate>::infinity();
  Coordinate upper = std::numeric_limits<Coordinate>::infinity();

  /// @param subset scratch memory
  MiddleBracket(
    const TSample* samples, std::size_t count, int axis, std::vector<Coordinate>& subset)
  {
    constexpr std::size_t largestSubset = 32768;
    // The last bits of the root do not affect results, only the size of the subset.
    const double root = std::cbrt(static_cast<double>(count));
    const std::size_t size = std::min(static_cast<std::size_t>(root * root), largestSubset);
    subset.resize(std::max(subset.size(), size));
    std::uint64_t state = count;
    for (std::size_t i = 0; i < size; ++i)
    {
      state = state * 6364136223846793005u + 1442695040888963407u;
      // Maps a 32-bit random number to [0, count) by a product; large counts are sampled in steps.
      const std::size_t random = static_cast<std::size_t>(state >> 32);
      const std::size_t step = (count >> 32) + 1;
      subset[i] = samples[((random * (count / step)) >> 32) * step].position[axis];
    }
    // The middle's rank in the subset has a standard deviation of sqrt(size) / 2.
    const auto margin = static_cast<std::size_t>(1.4 * std::sqrt(static_cast<double>(size))) + 1;
    const std::size_t middle = size / 2;
    if (margin < middle && middle + margin < size)
    {
      this->lower = selectMiddle(subset, size, middle - margin).first;
      this->upper = selectMiddle(subset, size, middle + margin).first;
    }
  }
};

} // namespace isopoint
