// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isopoint
{

/// How the value at a place follows from the samples around it (docs/algorithm.md, section 13).
enum class PlaceMethod : std::uint8_t
{
  Blend,     // the mean of four fits, weighted by their estimated errors
  Cubic,     // a polynomial of degree three
  Quadratic, // of degree two
  Affine,    // of degree one
  Nearest    // the nearest sample
};

/// How many positions a method fits to. One more limits their weights.
constexpr std::size_t fittedCount(PlaceMethod method)
{
  constexpr std::array<std::size_t, 5> counts{ 64, 48, 27, 13, 1 };
  return counts[static_cast<std::size_t>(method)];
}

} // namespace isopoint
