// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/Extractor.h"

#include "Library/ExtractionOptions.h"
#include "Library/SampleReader.h"
#include "Library/Surface.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

isopoint_extractor* isopoint_create_extractor(void)
{
  isopoint_extractor* created = nullptr;
  isopoint::attempt([&]() { created = new isopoint_extractor; });
  return created;
}

void isopoint_destroy_extractor(isopoint_extractor* extractor)
{
  isopoint::destroy(extractor);
}

isopoint_status isopoint_set_extractor_threads(isopoint_extractor* extractor, int32_t threads)
{
  return isopoint::runOn(extractor, "extractor",
    [&]()
    {
      isopoint::setThreads(extractor->Execution, threads);
      extractor->Threads = threads;
    });
}

isopoint_status isopoint_set_extractor_callbacks(isopoint_extractor* extractor,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user)
{
  return isopoint::runOn(extractor, "extractor",
    [&]() { isopoint::setCallbacks(extractor->Execution, progress, is_canceled, user); });
}

isopoint_status isopoint_set_value_name(isopoint_extractor* extractor, const char* name)
{
  return isopoint::runOn(extractor, "extractor", [&]() { extractor->Name = name ? name : ""; });
}

isopoint_status isopoint_set_values_negated(isopoint_extractor* extractor, int32_t are_negated)
{
  return isopoint::runOn(
    extractor, "extractor", [&]() { extractor->AreNegated = are_negated != 0; });
}

isopoint_status isopoint_set_samples(isopoint_extractor* extractor, const isopoint_array* positions,
  const isopoint_array* values, const isopoint_array* excluded)
{
  bool isReplacing = false;
  const isopoint_status status = isopoint::runOn(extractor, "extractor",
    [&]()
    {
      const isopoint::SampleReader read(positions, values, excluded);
      const isopoint::SampleTypes types = read.types();
      isReplacing = true;
      isopoint::loadOrReplace(
        extractor->makeExecution(), nullptr, extractor->Extractor, types, read.count(), read);
      extractor->Types = types;
      extractor->Counts = read.counts();
      extractor->Skipped = read.skippedItems(extractor->Extractor.skippedCount());
      extractor->HasSamples = true;
      extractor->HasValues = values != nullptr;
    });
  if (status != ISOPOINT_OK && isReplacing)
  {
    extractor->clear();
  }
  return status;
}

int64_t isopoint_get_sample_count(const isopoint_extractor* extractor)
{
  return extractor ? static_cast<int64_t>(extractor->Extractor.sampleCount()) : 0;
}

int64_t isopoint_get_skipped_count(const isopoint_extractor* extractor)
{
  return extractor ? static_cast<int64_t>(extractor->Extractor.skippedCount()) : 0;
}

void isopoint_get_value_range(const isopoint_extractor* extractor, double range[2])
{
  if (!range)
  {
    return;
  }
  const bool hasSamples =
    extractor && extractor->HasValues && extractor->Extractor.sampleCount() > 0;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto [least, greatest] =
    hasSamples ? extractor->Extractor.valueRange() : std::make_pair(nothing, nothing);
  range[0] = least;
  range[1] = greatest;
}

isopoint_status isopoint_extract(isopoint_extractor* extractor, const double* isovalues,
  int64_t count, const isopoint_options* options, isopoint_surface** surface)
{
  return isopoint::runOnSamples(extractor,
    [&]()
    {
      isopoint::require(surface, "pointer to the surface");
      constexpr std::int64_t most = 1 << 24;
      if (count < 0 || count > most)
      {
        throw isopoint::UsageError("The number of isovalues is " + std::to_string(count) +
                                   ". Pass a number from 0 to 2^24.");
      }
      if (count > 0)
      {
        isopoint::require(isovalues, "pointer to isovalues");
      }
      if (!extractor->HasValues)
      {
        throw isopoint::UsageError(
          "The samples have no values. Pass values to isopoint_set_samples().",
          isopoint::UsageError::Order);
      }
      const isopoint::Options chosen = isopoint::optionsFrom(options);
      isopoint::Report report(
        chosen, isopoint::sortedIsovalues(std::vector<double>(isovalues, isovalues + count)));
      report.array = extractor->Name;
      report.areNegated = extractor->AreNegated;
      report.countSamples(extractor->Extractor, extractor->Counts);
      const isopoint::Execution execution = extractor->makeExecution();
      std::vector<isopoint::ExtractedIsosurface> parts = isopoint::extractIsovalues(
        isopoint::partOf(execution, 0.0, 0.95), extractor->Extractor, chosen, 0, report);
      auto made = std::make_unique<isopoint_surface>(execution, std::move(parts), chosen,
        extractor->Types.areFloatPositions, report,
        static_cast<std::size_t>(extractor->Counts.items));
      made->messages = isopoint::describeReport(report, isopoint::memberName);
      isopoint::setCallbacks(made->execution, nullptr, nullptr, nullptr);
      execution.progress(1.0);
      *surface = made.release();
    });
}
