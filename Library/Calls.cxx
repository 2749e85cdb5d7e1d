// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/isopoint.h"

#include "Core/Base/Threads.h"
#include "Core/Contour.h"
#include "Core/Failure.h"
#include "Library/Arrays.h"
#include "Library/Probe.h"
#include "Library/RunningCall.h"
#include "Library/SampleReader.h"
#include "Library/Surface.h"
#include "Library/VersionedOptions.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef _WIN32
#include <windows.h>
#endif

using isopoint::UsageError;

namespace
{

/// The message of this thread's last failed call.
thread_local const char* lastError = "";
thread_local std::string lastText; // not touched where memory is lacking: its first use takes some

isopoint_status fail(isopoint_status status, std::string& message)
{
  lastText.swap(message);
  lastError = lastText.c_str();
  return status;
}

isopoint_status statusOf(UsageError::Kinds kind)
{
  switch (kind)
  {
    case UsageError::Array:
      return ISOPOINT_INVALID_ARRAY;
    case UsageError::Option:
      return ISOPOINT_INVALID_OPTION;
    case UsageError::Order:
      return ISOPOINT_INVALID_ORDER;
    case UsageError::Fork:
      return ISOPOINT_FORKED;
    default:
      return ISOPOINT_INVALID_ARGUMENT;
  }
}

/// Converts the current exception to a status and a message.
isopoint_status failWithException()
{
  isopoint::Failure failure = isopoint::describeException();
  switch (failure.kind)
  {
    case isopoint::Failure::Aborted:
      failure.text = "Canceled.";
      return fail(ISOPOINT_CANCELED, failure.text);
    case isopoint::Failure::InvalidUsage:
      return fail(statusOf(failure.usage), failure.text);
    case isopoint::Failure::OutOfMemory:
      lastError = isopoint::outOfMemoryText;
      return ISOPOINT_OUT_OF_MEMORY;
    default:
      return fail(ISOPOINT_INTERNAL_ERROR, failure.text);
  }
}

/// Runs a function; no exception leaves the library.
template <class Function>
isopoint_status attempt(const Function& function)
{
  try
  {
    function();
    return ISOPOINT_OK;
  }
  catch (...)
  {
    return failWithException();
  }
}

/// Runs a call, unless this process was forked during another.
template <class Call>
isopoint_status run(const Call& call)
{
  return attempt(
    [&]()
    {
      const isopoint::RunningCall running;
      call();
    });
}

/// Frees an object, unless a lock may forbid it.
template <class T>
void destroy(T* object)
{
  if (!isopoint::RunningCall::wasForkedMeanwhile())
  {
    delete object;
  }
}

/// @throws UsageError if a pointer is null
void require(const void* pointer, const char* name)
{
  if (!pointer)
  {
    throw UsageError(std::string("The ") + name + " is null. Pass one.");
  }
}

/// Runs a call on an object, unless it is null.
template <class Call>
isopoint_status runOn(const void* object, const char* name, const Call& call)
{
  return run(
    [&]()
    {
      require(object, name);
      call();
    });
}

// Programs may leave padding unset, and later versions could put members there.
static_assert(
  sizeof(isopoint_options) == offsetof(isopoint_options, minimum_piece_size) + sizeof(double));
static_assert(sizeof(isopoint_probe_options) ==
              offsetof(isopoint_probe_options, outside_number) + sizeof(double));

/// Converts the name of an option, such as DropGaps, to that of its member, drop_gaps.
std::string memberName(const char* name)
{
  std::string member;
  for (; *name != '\0'; ++name)
  {
    const auto character = static_cast<unsigned char>(*name);
    if (std::isupper(character) && !member.empty())
    {
      member += '_';
    }
    member += static_cast<char>(std::tolower(character));
  }
  return member;
}

/// Calls visit(member of isopoint_options, member of Options) for each option.
template <class Visitor>
void forEachMember(const Visitor& visit)
{
  using C = isopoint_options;
  using Core = isopoint::Options;
  visit(&C::triangles, &Core::triangles);
  visit(&C::projection, &Core::projection);
  visit(&C::normal_method, &Core::normalMethod);
  visit(&C::drop_gaps, &Core::dropGaps);
  visit(&C::compute_normals, &Core::computeNormals);
  visit(&C::compute_gradients, &Core::computeGradients);
  visit(&C::compute_projection_orders, &Core::computeProjectionOrders);
  visit(&C::output_points_precision, &Core::outputPointsPrecision);
  visit(&C::number_of_neighbors, &Core::numberOfNeighbors);
  visit(&C::compute_splats, &Core::computeSplats);
  visit(&C::angle, &Core::angle);
  visit(&C::keep_tetrahedra, &Core::keepTetrahedra);
  visit(&C::regularize, &Core::regularize);
  visit(&C::keep_hull_slivers, &Core::keepHullSlivers);
  visit(&C::capping, &Core::capping);
  visit(&C::minimum_piece_size, &Core::minimumPieceSize);
}

/// The name of an option that is on or off.
std::string switchName(bool isopoint::Options::*value)
{
  std::string name =
    value == &isopoint::Options::triangles ? "triangles" : "keep_tetrahedra"; // of no property
  isopoint::forEveryOption(
    [&](const auto& option)
    {
      if constexpr (std::is_same_v<decltype(option.value), bool isopoint::Options::*>)
      {
        name = option.value == value ? memberName(option.name) : name;
      }
    });
  return name;
}

/// @param given null for the defaults, or options of any version 1.x
/// @throws UsageError if one is unknown or out of range
isopoint::Options optionsFrom(const isopoint_options* given)
{
  isopoint_options all;
  isopoint_initialize_options(&all, sizeof(all));
  if (given)
  {
    constexpr std::size_t sizeOf1_0 = 80;
    isopoint::takeOptions(*given, sizeOf1_0, "isopoint_initialize_options()", all);
  }
  isopoint::Options options;
  forEachMember(
    [&](auto member, auto option)
    {
      using T = std::decay_t<decltype(options.*option)>;
      options.*option = static_cast<T>(all.*member);
      if constexpr (std::is_same_v<T, bool>)
      {
        if (all.*member != 0 && all.*member != 1)
        {
          throw UsageError(switchName(option) + " is " + std::to_string(all.*member) +
                             ". Use 0 for off and 1 for on.",
            UsageError::Option);
        }
      }
    });
  isopoint::checkOptions(options, memberName);
  return isopoint::effectiveOptions(options);
}

/// Keeps the library on Windows when a program unloads it: oneTBB's threads may still run. Linux
/// always keeps it, by CMakeLists.txt, and macOS, since it has thread_local variables.
void stayLoaded()
{
#ifdef _WIN32
  HMODULE library = nullptr;
  GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_PIN,
    reinterpret_cast<LPCWSTR>(&stayLoaded), &library);
#endif
}

/// @param threads maximum number, or 0 for all cores
/// @throws UsageError if it is negative
void setThreads(isopoint::Execution& execution, std::int32_t threads)
{
  if (threads < 0)
  {
    throw UsageError("The number of threads is " + std::to_string(threads) +
                     ". Pass 0, for all cores, or a number above.");
  }
  isopoint::Execution chosen;
  const std::size_t available = isopoint::availableThreadsOfRank();
  const std::size_t most =
    threads > 0 ? std::min(static_cast<std::size_t>(threads), available) : available;
  if (most > 1)
  {
    stayLoaded();
    isopoint::useThreads(chosen, most);
  }
  execution.parallelFor = chosen.parallelFor;
  execution.threads = chosen.threads;
}

/// @param progress, cancels may be null
void setCallbacks(isopoint::Execution& execution, isopoint_progress_callback progress,
  isopoint_cancel_callback cancels, void* user)
{
  isopoint::Execution chosen;
  if (progress)
  {
    chosen.progress = [progress, user](double fraction) { progress(user, fraction); };
  }
  if (cancels)
  {
    chosen.aborted = [cancels, user]() { return cancels(user) != 0; };
  }
  execution.progress = chosen.progress;
  execution.aborted = chosen.aborted;
}

} // namespace

struct isopoint_extractor
{
  isopoint::IsosurfaceExtractor Extractor;
  isopoint::SampleTypes Types;
  isopoint::CloudCounts Counts;
  std::string Name;        // of the values
  bool HasSamples = false; // even if all are skipped
  bool HasValues = false;
  std::int32_t Threads = 0;      // 0: all cores
  isopoint::Execution Execution; // with its callbacks

  void clear()
  {
    this->Extractor.clear();
    this->Counts = {};
    this->HasSamples = this->HasValues = false;
  }

  /// Of one call: the number of available cores may change.
  isopoint::Execution makeExecution() const
  {
    isopoint::Execution execution = this->Execution;
    setThreads(execution, this->Threads);
    return execution;
  }
};

namespace
{

/// @throws UsageError
void requireSamples(const isopoint_extractor& extractor)
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

} // namespace

void isopoint_initialize_options(isopoint_options* options, size_t size)
{
  isopoint_options all{};
  all.size = size;
  const isopoint::Options defaults;
  forEachMember([&](auto member, auto option)
    { all.*member = static_cast<std::decay_t<decltype(all.*member)>>(defaults.*option); });
  isopoint::giveOptions(all, options, size);
}

const char* isopoint_version(void)
{
  return ISOPOINT_VERSION;
}

int32_t isopoint_version_number(void)
{
  return ISOPOINT_VERSION_NUMBER;
}

const char* isopoint_get_error(void)
{
  return lastError;
}

isopoint_extractor* isopoint_create_extractor(void)
{
  isopoint_extractor* created = nullptr;
  attempt([&]() { created = new isopoint_extractor; });
  return created;
}

void isopoint_destroy_extractor(isopoint_extractor* extractor)
{
  destroy(extractor);
}

isopoint_status isopoint_set_extractor_threads(isopoint_extractor* extractor, int32_t threads)
{
  return runOn(extractor, "extractor",
    [&]()
    {
      setThreads(extractor->Execution, threads);
      extractor->Threads = threads;
    });
}

isopoint_status isopoint_set_extractor_callbacks(isopoint_extractor* extractor,
  isopoint_progress_callback progress, isopoint_cancel_callback cancels, void* user)
{
  return runOn(
    extractor, "extractor", [&]() { setCallbacks(extractor->Execution, progress, cancels, user); });
}

isopoint_status isopoint_set_value_name(isopoint_extractor* extractor, const char* name)
{
  return runOn(extractor, "extractor", [&]() { extractor->Name = name ? name : ""; });
}

isopoint_status isopoint_set_samples(isopoint_extractor* extractor, const isopoint_array* positions,
  const isopoint_array* values, const isopoint_array* excluded)
{
  bool isReplacing = false;
  const isopoint_status status = runOn(extractor, "extractor",
    [&]()
    {
      const isopoint::SampleReader read(positions, values, excluded);
      const isopoint::SampleTypes types = read.types();
      isReplacing = true;
      isopoint::loadOrReplace(
        extractor->makeExecution(), nullptr, extractor->Extractor, types, read.count(), read);
      extractor->Types = types;
      extractor->Counts = read.counts();
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
  return runOnSamples(extractor,
    [&]()
    {
      const std::vector<isopoint::Vector> all = isopoint::placesFrom(places);
      const isopoint::ProbeOptions chosen = isopoint::probeOptionsFrom(options);
      const auto probed = isopoint::probedArrays(
        arrays, array_count, results, extractor->Counts.items, all.size(), chosen);
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
  return runOnSamples(extractor,
    [&]()
    {
      require(neighborhoods, "pointer to neighborhoods");
      const isopoint::Execution execution = extractor->makeExecution();
      isopoint::Execution own = execution;
      setCallbacks(own, nullptr, nullptr, nullptr);
      *neighborhoods = new isopoint_neighborhoods{ own,
        extractor->Extractor.findNeighborhoods(
          execution, isopoint::placesFrom(places), isopoint::probeOptionsFrom(options)),
        static_cast<std::size_t>(extractor->Counts.items) };
    });
}

isopoint_status isopoint_set_neighborhoods_threads(
  isopoint_neighborhoods* neighborhoods, int32_t threads)
{
  return runOn(
    neighborhoods, "neighborhoods", [&]() { setThreads(neighborhoods->execution, threads); });
}

isopoint_status isopoint_set_neighborhoods_callbacks(isopoint_neighborhoods* neighborhoods,
  isopoint_progress_callback progress, isopoint_cancel_callback cancels, void* user)
{
  return runOn(neighborhoods, "neighborhoods",
    [&]() { setCallbacks(neighborhoods->execution, progress, cancels, user); });
}

isopoint_status isopoint_probe_neighborhoods(const isopoint_neighborhoods* neighborhoods,
  const isopoint_array* arrays, int64_t array_count, const isopoint_probe_result* results,
  uint8_t* flags, size_t flags_size)
{
  return runOn(neighborhoods, "neighborhoods",
    [&]()
    {
      const isopoint::Neighborhoods& found = neighborhoods->found;
      isopoint::probeNeighborhoods(neighborhoods->execution, found,
        isopoint::probedArrays(arrays, array_count, results, neighborhoods->sampleCount,
          found.places.size(), found.options));
      if (flags)
      {
        isopoint::requireMemory(flags, flags_size, "flags", found.kinds.size(), 1);
        std::copy(found.kinds.begin(), found.kinds.end(), flags);
      }
    });
}

isopoint_status isopoint_get_weights(
  isopoint_neighborhoods* neighborhoods, isopoint_weights* weights)
{
  return runOn(neighborhoods, "neighborhoods",
    [&]()
    {
      require(weights, "pointer to weights");
      *weights = neighborhoods->weights();
    });
}

void isopoint_destroy_neighborhoods(isopoint_neighborhoods* neighborhoods)
{
  destroy(neighborhoods);
}

isopoint_status isopoint_extract(isopoint_extractor* extractor, const double* isovalues,
  int64_t count, const isopoint_options* options, isopoint_surface** surface)
{
  return runOnSamples(extractor,
    [&]()
    {
      require(surface, "pointer to the surface");
      constexpr std::int64_t most = 1 << 24;
      if (count < 0 || count > most)
      {
        throw UsageError("The number of isovalues is " + std::to_string(count) +
                         ". Pass a number from 0 to 2^24.");
      }
      if (count > 0)
      {
        require(isovalues, "pointer to isovalues");
      }
      if (!extractor->HasValues)
      {
        throw UsageError(
          "The samples have no values. Pass values to isopoint_set_samples().", UsageError::Order);
      }
      const isopoint::Options chosen = optionsFrom(options);
      isopoint::Report report(
        chosen, isopoint::sortedIsovalues(std::vector<double>(isovalues, isovalues + count)));
      report.array = extractor->Name;
      report.countSamples(extractor->Extractor, extractor->Counts);
      const isopoint::Execution execution = extractor->makeExecution();
      std::vector<isopoint::ExtractedIsosurface> parts = isopoint::extractIsovalues(
        isopoint::partOf(execution, 0.0, 0.95), extractor->Extractor, chosen, 0, report);
      auto made = std::make_unique<isopoint_surface>(execution, std::move(parts), chosen,
        extractor->Types.areFloatPositions, report,
        static_cast<std::size_t>(extractor->Counts.items));
      made->messages = isopoint::describeReport(report, memberName);
      setCallbacks(made->execution, nullptr, nullptr, nullptr);
      execution.progress(1.0);
      *surface = made.release();
    });
}

void isopoint_destroy_surface(isopoint_surface* surface)
{
  destroy(surface);
}

isopoint_status isopoint_set_surface_threads(isopoint_surface* surface, int32_t threads)
{
  return runOn(surface, "surface", [&]() { setThreads(surface->execution, threads); });
}

isopoint_status isopoint_set_surface_callbacks(isopoint_surface* surface,
  isopoint_progress_callback progress, isopoint_cancel_callback cancels, void* user)
{
  return runOn(
    surface, "surface", [&]() { setCallbacks(surface->execution, progress, cancels, user); });
}

namespace
{

/// Whether options have the same effect.
bool areSame(const isopoint::Options& first, const isopoint::Options& second)
{
  bool areSame = first.triangles == second.triangles;
  isopoint::forEachOption(first,
    [&](const auto& option) { areSame = areSame && first.*option.value == second.*option.value; });
  return areSame;
}

/// The message of this index, or null.
const isopoint::Message* messageAt(const isopoint_surface* surface, std::int64_t index)
{
  const bool isThere =
    surface && index >= 0 && static_cast<std::size_t>(index) < surface->messages.size();
  return isThere ? &surface->messages[static_cast<std::size_t>(index)] : nullptr;
}

} // namespace

const char* isopoint_get_message(
  const isopoint_surface* surface, int64_t index, int32_t* is_warning)
{
  const isopoint::Message* const message = messageAt(surface, index);
  if (message && is_warning)
  {
    *is_warning = message->kind == isopoint::Message::Warning ? 1 : 0;
  }
  return message ? message->text.c_str() : nullptr;
}

const char* isopoint_get_message_cause(const isopoint_surface* surface, int64_t index)
{
  const isopoint::Message* const message = messageAt(surface, index);
  return message ? message->cause.c_str() : nullptr;
}

int32_t isopoint_get_message_code(const isopoint_surface* surface, int64_t index)
{
  const isopoint::Message* const message = messageAt(surface, index);
  return message ? message->code : 0;
}

isopoint_status isopoint_join_messages(isopoint_surface* surface, const isopoint_surface* other)
{
  return runOn(surface, "surface",
    [&]()
    {
      require(other, "other surface");
      if (surface->report.isovalues != other->report.isovalues)
      {
        throw UsageError("The surfaces have different isovalues. Extract them at the same.");
      }
      if (surface == other || !areSame(surface->options, other->options) || !surface->isExtracted ||
          !other->isExtracted)
      {
        throw UsageError("Messages are joined of two surfaces, extracted with the same options.");
      }
      isopoint::Report joined = surface->report;
      joined.add(other->report);
      surface->messages = isopoint::describeReport(joined, memberName);
      surface->report = std::move(joined);
    });
}

int64_t isopoint_get_unprojected_count(const isopoint_surface* surface)
{
  return surface ? static_cast<int64_t>(surface->report.unprojectedPoints) : 0;
}

int64_t isopoint_get_dropped_count(const isopoint_surface* surface)
{
  return surface ? static_cast<int64_t>(surface->report.droppedCount()) : 0;
}

isopoint_status isopoint_get_array(
  const isopoint_surface* surface, int32_t array_id, isopoint_array* array)
{
  return runOn(surface, "surface",
    [&]()
    {
      require(array, "pointer to the array");
      *array = surface->array(array_id);
    });
}

isopoint_status isopoint_interpolate(
  const isopoint_surface* surface, const isopoint_array* of_samples, void* result, size_t size)
{
  return runOn(surface, "surface", [&]() { surface->interpolate(of_samples, result, size); });
}

isopoint_status isopoint_create_surface(const isopoint_array* points, const isopoint_array* normals,
  const isopoint_array* axes, const isopoint_array* polygons, isopoint_surface** surface)
{
  return runOn(surface, "pointer to the surface",
    [&]()
    {
      isopoint::Execution execution;
      setThreads(execution, 0);
      *surface = new isopoint_surface(execution, points, normals, axes, polygons);
    });
}

isopoint_status isopoint_make_splat_mesh(isopoint_surface* surface, double scale)
{
  return runOn(surface, "surface", [&]() { surface->makeSplatMesh(scale); });
}

isopoint_status isopoint_average_at_splat_vertices(
  const isopoint_surface* surface, const isopoint_array* of_points, void* result, size_t size)
{
  return runOn(
    surface, "surface", [&]() { surface->averageAtSplatVertices(of_points, result, size); });
}
