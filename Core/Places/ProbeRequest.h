// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/PlaceMethod.h"
#include "Core/Places/PlaceKind.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace isopoint
{

/// What places outside the samples get (docs/algorithm.md, section 13.4).
enum class OutsideStrategy : std::uint8_t
{
  Number,     // a number, and a gradient that is not a number
  Nearest,    // the value of the nearest sample, and the gradient 0
  Extrapolate // what the method gives: no place counts as outside
};

/// How to probe places.
struct ProbeOptions
{
  PlaceMethod method = PlaceMethod::Blend;
  OutsideStrategy outside = OutsideStrategy::Number;
  double outsideNumber = std::numeric_limits<double>::quiet_NaN();
};

/// An array of the samples to probe, and memory for the results. Its functions are called from any
/// thread.
struct ProbedArray
{
  int components = 1;
  double valueError = 0.0; // least standard error of each value, as by rounding
  /// Reads one component of samples, given by their ids.
  std::function<void(const std::uint64_t* ids, std::size_t count, int component, double* numbers)>
    read;
  /// If not empty, the range of a component in all samples, within which values stay. Called when
  /// fits leave the range of the samples around a place.
  std::function<std::pair<double, double>(int component)> range;
  bool isNearest = false;      // as by PlaceMethod::Nearest, whatever the method
  double* values = nullptr;    // by place, then component
  double* gradients = nullptr; // likewise, three each; null: none
  /// If not empty, called instead of writing values, with the id of the nearest sample whose
  /// components are all finite, or null if there is none or the place is outside: for
  /// PlaceMethod::Nearest, which keeps types. On ranks, ids number the items of all ranks.
  std::function<void(std::size_t place, const std::uint64_t* id)> writeNearest;
};

/// A function for ProbedArray::range that calls find(component) for all components when it is first
/// called. Not for ranks, where finding a range is collective.
template <class Find>
auto foundOnce(int components, const Find& find)
{
  struct Ranges
  {
    std::once_flag found;
    std::vector<std::pair<double, double>> all;
  };
  return [ranges = std::make_shared<Ranges>(), components, find](int component)
  {
    std::call_once(ranges->found,
      [&]()
      {
        for (int c = 0; c < components; ++c)
        {
          ranges->all.push_back(find(c));
        }
      });
    return ranges->all[static_cast<std::size_t>(component)];
  };
}

} // namespace isopoint
