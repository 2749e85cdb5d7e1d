// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_EndSamples_h
#define isopoint_EndSamples_h

#include "Core/ExtractionRequest.h"

#include <cstdint>
#include <vector>

namespace isopoint
{

/// The ids of the samples at the ends of edges, and of samples coincident with them, in ascending
/// order.
std::vector<std::uint64_t> endSamples(const std::vector<ExtractedIsosurface>& surfaces);

/// Replaces each id by its position among the sorted ids that endSamples() returns.
void renumberEndSamples(
  std::vector<ExtractedIsosurface>& surfaces, const std::vector<std::uint64_t>& ids);

/// For each rank those of some sorted ids that its samples have, counted from its first one.
/// @param counts the number of samples of each rank
std::vector<std::vector<std::uint64_t>> idsByRank(
  const std::vector<std::uint64_t>& ids, const std::vector<std::uint64_t>& counts);

} // namespace isopoint

#endif
