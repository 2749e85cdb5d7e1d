// SPDX-License-Identifier: GPL-3.0-or-later
// What isopoint.h declares for places.
#include "Library/Arrays.h"
#include "Library/Calls.h"
#include "Library/Extractor.h"
#include "Library/Places.h"
#include "Library/VersionedOptions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

static_assert(sizeof(isopoint_probe_options) == // see takeOptions()
              offsetof(isopoint_probe_options, outside_number) + sizeof(double));

void isopoint_initialize_probe_options(isopoint_probe_options* options, size_t size)
{
  isopoint_probe_options all{};
  all.size = size;
  all.outside_number = isopoint::ProbeOptions().outsideNumber;
  isopoint::giveOptions(all, options, size);
}

isopoint_status isopoint_probe(isopoint_extractor* extractor, const isopoint_array* places,
  const isopoint_array* arrays, int64_t array_count, const isopoint_probe_options* options,
  const isopoint_probe_result* results, uint8_t* flags, size_t flags_size)
{
  return isopoint::runOnSamples(extractor,
    [&]()
    {
      const std::vector<isopoint::Vector> all = isopoint::placesFrom(places);
      const isopoint::ProbeOptions chosen = isopoint::probeOptionsFrom(options);
      const auto probed = isopoint::probedArrays(arrays, array_count, results,
        extractor->Counts.items, extractor->Skipped, all.size(), chosen);
      if (flags)
      {
        isopoint::requireMemory(flags, flags_size, "flags", all.size(), 1);
      }
      extractor->Extractor.probe(extractor->makeExecution(), all, chosen, probed, flags);
    });
}

isopoint_status isopoint_find_neighborhoods(isopoint_extractor* extractor,
  const isopoint_array* places, const isopoint_probe_options* options,
  isopoint_neighborhoods** neighborhoods)
{
  return isopoint::runOnSamples(extractor,
    [&]()
    {
      isopoint::require(neighborhoods, "pointer to neighborhoods");
      const isopoint::Execution execution = extractor->makeExecution();
      isopoint::Execution own = execution;
      isopoint::setCallbacks(own, nullptr, nullptr, nullptr);
      *neighborhoods = new isopoint_neighborhoods{ own,
        extractor->Extractor.findNeighborhoods(
          execution, isopoint::placesFrom(places), isopoint::probeOptionsFrom(options)),
        static_cast<std::size_t>(extractor->Counts.items), extractor->Skipped };
    });
}

isopoint_status isopoint_set_neighborhoods_threads(
  isopoint_neighborhoods* neighborhoods, int32_t threads)
{
  return isopoint::runOn(neighborhoods, "neighborhoods",
    [&]() { isopoint::setThreads(neighborhoods->execution, threads); });
}

isopoint_status isopoint_set_neighborhoods_callbacks(isopoint_neighborhoods* neighborhoods,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user)
{
  return isopoint::runOn(neighborhoods, "neighborhoods",
    [&]() { isopoint::setCallbacks(neighborhoods->execution, progress, is_canceled, user); });
}

isopoint_status isopoint_probe_neighborhoods(const isopoint_neighborhoods* neighborhoods,
  const isopoint_array* arrays, int64_t array_count, const isopoint_probe_result* results,
  uint8_t* flags, size_t flags_size)
{
  return isopoint::runOn(neighborhoods, "neighborhoods",
    [&]()
    {
      const isopoint::Neighborhoods& found = neighborhoods->found;
      const auto probed = isopoint::probedArrays(arrays, array_count, results,
        neighborhoods->sampleCount, neighborhoods->skipped, found.places.size(), found.options);
      if (flags)
      {
        isopoint::requireMemory(flags, flags_size, "flags", found.kinds.size(), 1);
      }
      isopoint::probeNeighborhoods(neighborhoods->execution, found, probed);
      if (flags)
      {
        std::copy(found.kinds.begin(), found.kinds.end(), flags);
      }
    });
}

isopoint_status isopoint_get_weights(
  isopoint_neighborhoods* neighborhoods, isopoint_weights* weights)
{
  return isopoint::runOn(neighborhoods, "neighborhoods",
    [&]()
    {
      isopoint::require(weights, "pointer to weights");
      *weights = neighborhoods->weights();
    });
}

void isopoint_destroy_neighborhoods(isopoint_neighborhoods* neighborhoods)
{
  isopoint::destroy(neighborhoods);
}
