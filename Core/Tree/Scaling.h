// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
  constexpr int harmless = 200;
  return !std::is_same_v<typename TSample::Coordinate, float> && greatest > 0.0 &&
         std::abs(std::ilogb(greatest)) > harmless;
}

/// The median of the exponents of all positions: division by this power of two is exact, so that
/// results are the same at any scale. Few samples far away do not matter. O(n)
template <class TSample>
int medianExponent(const SampleTree<TSample>& tree)
{
  std::vector<int> exponents(tree.samples.size());
  std::transform(tree.samples.data(), tree.samples.data() + exponents.size(), exponents.begin(),
    exponentOf<TSample>);
  const auto middle = exponents.begin() + static_cast<std::ptrdiff_t>(exponents.size() / 2);
  std::nth_element(exponents.begin(), middle, exponents.end());
  return exponents.empty() ? 0 : *middle;
}

/// The exponent of the power of two that divides positions which are out of scale.
inline int scaleExponent(double greatest, int median)
{
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
  constexpr std::size_t grain = 1 << 14;
  forBatches(execution, tree.samples.size(), 16 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        for (auto& coordinate : tree.samples[i].position)
        {
          divide(coordinate, exponent);
        }
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
