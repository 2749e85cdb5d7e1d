// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Properties of places, combined by bitwise or.
enum PlaceKinds : std::uint8_t
{
  PlaceOutside = 1, // of the samples: all around are on one side, or the nearest one is far
  PlaceFlat = 2     // the samples around are in a plane, on a line or at one place
};

/// How many of the nearest positions tell these.
constexpr std::size_t countForKinds = 27;

/// The properties of a place by the nearest samples (docs/algorithm.md, section 13.4).
/// @param offsets of samples from the place, nearest first: at least one, different ones
std::uint8_t placeKinds(const std::vector<Vector>& offsets);

} // namespace isopoint
