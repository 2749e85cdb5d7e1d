// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Fit/PlaceMethod.h"
#include "Core/Places/PlaceKind.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

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
  double* values = nullptr;    // by place, then component
  double* gradients = nullptr; // likewise, three each; null: none
  /// If not empty, called instead of writing values, with the id of the nearest sample whose
  /// components are all finite, or null if there is none or the place is outside: for
  /// PlaceMethod::Nearest, which keeps types. On one rank only.
  std::function<void(std::size_t place, const std::uint64_t* id)> writeNearest;
};

} // namespace isopoint
