// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

namespace isopoint
{

/// The exponent of the power of two in a position's largest coordinate; 0 at the origin.
template <class TSample>
int exponentOf(const TSample& sample)
{
  const double greatest = std::max<double>(
    { std::abs(sample.position[0]), std::abs(sample.position[1]), std::abs(sample.position[2]) });
  return greatest > 0.0 ? std::ilogb(greatest) : 0;
}

/// The largest absolute coordinate; 0 without samples.
template <class TSample>
double greatestCoordinate(const SampleTree<TSample>& tree)
{
  double greatest = 0.0;
  for (std::size_t axis = 0; axis < 3 && !tree.isEmpty(); ++axis)
  {
    greatest =
      std::max({ greatest, std::abs(tree.region.lower[axis]), std::abs(tree.region.upper[axis]) });
  }
  return greatest;
}

/// Whether products of several coordinates may overflow or underflow. Those of type float do not.
template <class TSample>
bool isOutOfScale(double greatest)
{
  constexpr int harmless = 128;
  return !std::is_same_v<typename TSample::Coordinate, float> && greatest > 0.0 &&
         std::abs(std::ilogb(greatest)) > harmless;
}

/// The samples by exponentOf(), from that of the least positive number on. O(n)
template <class TSample>
std::vector<std::uint64_t> countExponents(const SampleTree<TSample>& tree)
{
  using Limits = std::numeric_limits<double>;
  constexpr int least = Limits::min_exponent - Limits::digits; // of denormalized numbers
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(Limits::max_exponent - least));
  for (std::size_t i = 0; i < tree.samples.size(); ++i)
  {
    ++counts[static_cast<std::size_t>(exponentOf(tree.samples[i]) - least)];
  }
  return counts;
}

/// The exponent of the power of two by which positions that are out of scale are divided: the
/// median of all, so that few samples far away do not matter. Division is exact, unless coordinates
/// are 2^1022 times as small as most: then they lose digits, or become 0.
/// @param greatest coordinate of all samples
/// @param counts by exponent, of all samples
inline int scaleExponent(double greatest, const std::vector<std::uint64_t>& counts)
{
  using Limits = std::numeric_limits<double>;
  std::uint64_t below = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 }) / 2;
  int median = Limits::min_exponent - Limits::digits;
  for (auto count = counts.begin(); below >= *count; ++count)
  {
    below -= *count;
    ++median;
  }
  return greatest > 1.0 ? std::max(median, 0) : median; // the greatest does not overflow
}

/// Divides a coordinate by 2^exponent.
template <class TCoordinate>
void divide(TCoordinate& coordinate, int exponent)
{
  coordinate = static_cast<TCoordinate>(std::ldexp(coordinate, -exponent));
}

/// Divides the positions of a tree of only a root by 2^exponent.
template <class TSample>
void dividePositions(const Execution& execution, SampleTree<TSample>& tree, int exponent)
{
  if (exponent == 0)
  {
    return;
  }
  forEachIndex(execution, tree.samples.size(),
    [&](std::size_t i)
    {
      for (auto& coordinate : tree.samples[i].position)
      {
        divide(coordinate, exponent);
      }
    });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    divide(tree.region.lower[axis], exponent);
    divide(tree.region.upper[axis], exponent);
  }
}

/// A reader as of loadSamples() whose positions are divided by 2^exponent.
template <class Reader>
auto dividedReader(const Reader& read, int exponent)
{
  return [&read, exponent](std::size_t id, auto* position, auto& value)
  {
    const bool takesPart = read(id, position, value);
    for (int axis = 0; takesPart && exponent != 0 && axis < 3; ++axis)
    {
      divide(position[axis], exponent);
    }
    return takesPart;
  };
}

} // namespace isopoint
