// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/ExtractionRequest.h"

#include <cstdint>
#include <vector>

namespace isopoint
{

/// The sorted ids of the samples at the ends of edges, and of samples coincident with them.
std::vector<std::uint64_t> endSamples(const std::vector<ExtractedIsosurface>& surfaces);

/// Replaces each id by its index in the result of endSamples().
void renumberEndSamples(
  std::vector<ExtractedIsosurface>& surfaces, const std::vector<std::uint64_t>& ids);

/// Distributes sorted ids to the ranks that have their samples; ids count from a rank's first one.
/// @param counts number of samples by rank
std::vector<std::vector<std::uint64_t>> idsByRank(
  const std::vector<std::uint64_t>& ids, const std::vector<std::uint64_t>& counts);

} // namespace isopoint
