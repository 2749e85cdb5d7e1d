// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Contour.h"
#include "Library/Calls.h"
#include "Library/Places.h"

#include <cstdint>
#include <string>

struct isopoint_extractor
{
  isopoint::IsosurfaceExtractor Extractor;
  isopoint::SampleTypes Types;
  isopoint::CloudCounts Counts;
  isopoint::SkippedItems Skipped;
  std::string Name;        // of the values
  bool AreNegated = false; // in the view of the user
  bool HasSamples = false; // even if all are skipped
  bool HasValues = false;
  std::int32_t Threads = 0;      // 0: all cores
  isopoint::Execution Execution; // with its callbacks

  void clear()
  {
    this->Extractor.clear();
    this->Counts = {};
    this->Skipped.reset();
    this->HasSamples = this->HasValues = false;
  }

  /// Of one call: the number of available cores may change.
  isopoint::Execution makeExecution() const
  {
    isopoint::Execution execution = this->Execution;
    isopoint::setThreads(execution, this->Threads);
    return execution;
  }
};

namespace isopoint
{

/// @throws UsageError if an extractor has no samples
inline void requireSamples(const isopoint_extractor& extractor)
{
  if (!extractor.HasSamples)
  {
    throw UsageError(
      "The extractor has no samples. Call isopoint_set_samples() first.", UsageError::Order);
  }
}

/// Runs a call on the samples of an extractor. It loses them if their tree may be invalid.
template <class Call>
isopoint_status runOnSamples(isopoint_extractor* extractor, const Call& call)
{
  const isopoint_status status = runOn(extractor, "extractor",
    [&]()
    {
      requireSamples(*extractor);
      call();
    });
  if (status == ISOPOINT_INTERNAL_ERROR)
  {
    extractor->clear();
  }
  return status;
}

} // namespace isopoint
