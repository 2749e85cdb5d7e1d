// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Places/PlaceEvaluator.h"
#include "Core/Places/ProbeRequest.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The samples around places and, for linear methods, their weights: all that arrays need.
/// Memory: 32 bytes a place, four for each sample around (36 with weights), and some for each
/// position in use.
struct Neighborhoods
{
  ProbeOptions options;
  std::vector<Vector> places;
  std::vector<std::uint8_t> kinds;   // PlaceKinds, by place
  std::vector<double> reaches;       // see NearbySamples
  std::vector<std::size_t> begins;   // of places in `around`, and the end
  std::vector<std::uint32_t> around; // indices of positions, nearest first
  std::vector<double> weights;       // four for each of these; empty for Blend
  std::vector<Vector> positions;     // that are around any place
  std::vector<std::size_t> idBegins; // of positions in `ids`, and the end
  std::vector<std::uint64_t> ids;    // of samples
  int exponent = 0; // places and positions are those of the input divided by 2^exponent

  /// @param isNumbered whether to number samples by their index in `ids` in place of their ids
  void surroundings(std::size_t place, bool isNumbered, NearbySamples& result) const;
};

/// Interpolates arrays at the places of neighborhoods.
/// @param areNumbered whether arrays are read by indices in Neighborhoods::ids in place of ids
/// @throws Aborted, std::bad_alloc
void probeNeighborhoods(const Execution& execution, const Neighborhoods& neighborhoods,
  const std::vector<ProbedArray>& arrays, bool areNumbered = false);

/// Divides gradients at so many places by 2^exponent. @throws Aborted
void divideGradients(const Execution& execution, const std::vector<ProbedArray>& arrays,
  std::size_t places, int exponent);

} // namespace isopoint
