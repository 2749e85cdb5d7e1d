// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_MedianSelection_h
#define isopoint_MedianSelection_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace isopoint
{

/// The coordinates of the two samples in the middle of a node, on one axis: those of rank
/// count / 2 - 1 and count / 2.
template <class TCoordinate>
struct MiddleCoordinates
{
  TCoordinate last;  // of the lower half
  TCoordinate first; // of the upper half
};

/// The coordinates of rank - 1 and rank among few, 0 < rank < count: each is ranked by counting the
/// smaller ones, which takes count^2 comparisons but no branch, and vectorises.
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
    // Equal coordinates hold the ranks from `smaller` on. The greatest one that holds a rank up to
    // rank - 1 is `last`; `first` follows from how many there are of it.
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

/// The coordinates of rank - 1 and rank, 0 < rank < count; reorders the coordinates. Passes without
/// unpredictable branches keep what lies between two elements of a small subset that probably
/// enclose the two sought, until few are left. O(count) on average, O(count log count) at worst.
template <class TCoordinate>
MiddleCoordinates<TCoordinate> selectMiddle(
  TCoordinate* coordinates, std::size_t count, std::size_t rank)
{
  constexpr std::size_t countingLimit = 40;
  constexpr std::size_t subsetSize = 16;
  constexpr std::size_t margin = 4; // two standard deviations of the rank in the subset
  while (count > countingLimit)
  {
    TCoordinate subset[subsetSize];
    for (std::size_t i = 0; i < subsetSize; ++i)
    {
      subset[i] = coordinates[(2 * i + 1) * count / (2 * subsetSize)];
    }
    const std::size_t middle = rank * subsetSize / count;
    constexpr TCoordinate infinity = std::numeric_limits<TCoordinate>::infinity();
    const TCoordinate lower =
      middle > margin ? selectByCounting(subset, subsetSize, middle - margin).first : -infinity;
    const TCoordinate upper = middle + margin < subsetSize
                                ? selectByCounting(subset, subsetSize, middle + margin).first
                                : infinity;
    std::size_t below = 0;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      below += coordinates[i] < lower ? 1 : 0;
      inside += ((coordinates[i] >= lower) & (coordinates[i] <= upper)) ? 1 : 0;
    }
    if (below >= rank || rank >= below + inside || 4 * inside > 3 * count)
    {
      std::nth_element(coordinates, coordinates + rank, coordinates + count);
      return { *std::max_element(coordinates, coordinates + rank), coordinates[rank] };
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const TCoordinate coordinate = coordinates[i];
      coordinates[kept] = coordinate;
      kept += ((coordinate >= lower) & (coordinate <= upper)) ? 1 : 0;
    }
    rank -= below;
    count = kept;
  }
  return selectByCounting(coordinates, count, rank);
}

/// Bounds that very likely enclose both middle coordinates, and few others, taken from a random
/// subset [FR75]. The generator is seeded by the count, so that runs are repeatable.
template <class TSample>
struct MiddleBracket
{
  using Coordinate = typename TSample::Coordinate;
  Coordinate lower = -std::numeric_limits<Coordinate>::infinity();
  Coordinate upper = std::numeric_limits<Coordinate>::infinity();

  MiddleBracket(
    const TSample* samples, std::size_t count, int axis, std::vector<Coordinate>& subset)
  {
    constexpr std::size_t largestSubset = 32768;
    const double root = std::cbrt(static_cast<double>(count));
    const std::size_t size = std::min(static_cast<std::size_t>(root * root), largestSubset);
    subset.resize(size);
    std::uint64_t state = count;
    for (Coordinate& coordinate : subset)
    {
      state = state * 6364136223846793005u + 1442695040888963407u;
      // The upper half of the product of two 32-bit numbers maps one range onto the other; more
      // than 2^32 samples are reached in steps.
      const std::size_t random = static_cast<std::size_t>(state >> 32);
      const std::size_t step = (count >> 32) + 1;
      coordinate = samples[((random * (count / step)) >> 32) * step].position[axis];
    }
    // The middle's rank in the subset has a standard deviation of sqrt(size) / 2.
    const auto margin = static_cast<std::size_t>(1.4 * std::sqrt(static_cast<double>(size))) + 1;
    const std::size_t middle = size / 2;
    if (margin < middle && middle + margin < size)
    {
      const auto low = subset.begin() + static_cast<std::ptrdiff_t>(middle - margin);
      const auto high = subset.begin() + static_cast<std::ptrdiff_t>(middle + margin);
      std::nth_element(subset.begin(), low, subset.end());
      this->lower = *low;
      std::nth_element(low, high, subset.end());
      this->upper = *high;
    }
  }
};

} // namespace isopoint

#endif
