// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Probe.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isopoint
{

/// Which samples are not in use, excluded or not finite; null: none.
using SkippedItems = std::shared_ptr<const std::vector<bool>>;

/// The arguments of isopoint_probe(), checked. @throws UsageError
std::vector<Vector> placesFrom(const isopoint_array* places);
ProbeOptions probeOptionsFrom(const isopoint_probe_options* given);
std::vector<ProbedArray> probedArrays(const isopoint_array* arrays, std::int64_t count,
  const isopoint_probe_result* results, std::size_t sampleCount, const SkippedItems& skipped,
  std::size_t placeCount, const ProbeOptions& options);

} // namespace isopoint

struct isopoint_neighborhoods
{
  isopoint::Execution execution;
  isopoint::Neighborhoods found;
  std::size_t sampleCount;
  isopoint::SkippedItems skipped;

  /// See isopoint_get_weights(). @throws isopoint::UsageError, std::bad_alloc
  isopoint_weights weights();

  std::vector<std::int64_t> begins{};
  std::vector<std::int64_t> samples{};
  std::vector<double> values{};
  std::vector<double> gradients{};
};
