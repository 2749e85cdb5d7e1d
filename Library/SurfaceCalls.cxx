// SPDX-License-Identifier: GPL-3.0-or-later
// What isopoint.h declares for surfaces.
#include "Library/Calls.h"
#include "Library/ExtractionOptions.h"
#include "Library/Surface.h"
#include "Library/VersionedOptions.h"

#include <cstddef>
#include <cstdint>
#include <utility>

void isopoint_destroy_surface(isopoint_surface* surface)
{
  isopoint::destroy(surface);
}

isopoint_status isopoint_set_surface_threads(isopoint_surface* surface, int32_t threads)
{
  return isopoint::runOn(
    surface, "surface", [&]() { isopoint::setThreads(surface->execution, threads); });
}

isopoint_status isopoint_set_surface_callbacks(isopoint_surface* surface,
  isopoint_progress_callback progress, isopoint_cancel_callback is_canceled, void* user)
{
  return isopoint::runOn(surface, "surface",
    [&]() { isopoint::setCallbacks(surface->execution, progress, is_canceled, user); });
}

namespace
{

using isopoint::Message;
static_assert(isopoint::haveSameNumbers(
  { Message::SkippedSamples, Message::NoSamples, Message::ConstantValues, Message::IsovalueOutside,
    Message::TooFewSamples, Message::AllInGaps, Message::NoCrossing, Message::PointsWithoutFit,
    Message::SplatsApart, Message::BeyondFloat, Message::NoIsovalues, Message::OnlyAtSamples,
    Message::RoundedPositions, Message::DifferentValues, Message::IsovalueAtEnd },
  { ISOPOINT_MESSAGE_SKIPPED_SAMPLES, ISOPOINT_MESSAGE_NO_SAMPLES, ISOPOINT_MESSAGE_CONSTANT_VALUES,
    ISOPOINT_MESSAGE_ISOVALUE_OUTSIDE, ISOPOINT_MESSAGE_TOO_FEW_SAMPLES,
    ISOPOINT_MESSAGE_ALL_IN_GAPS, ISOPOINT_MESSAGE_NO_CROSSING, ISOPOINT_MESSAGE_POINTS_WITHOUT_FIT,
    ISOPOINT_MESSAGE_SPLATS_APART, ISOPOINT_MESSAGE_BEYOND_FLOAT, ISOPOINT_MESSAGE_NO_ISOVALUES,
    ISOPOINT_MESSAGE_ONLY_AT_SAMPLES, ISOPOINT_MESSAGE_ROUNDED_POSITIONS,
    ISOPOINT_MESSAGE_DIFFERENT_VALUES, ISOPOINT_MESSAGE_ISOVALUE_AT_END }));

/// Whether options have the same effect.
bool areSame(const isopoint::Options& first, const isopoint::Options& second)
{
  bool areSame = first.triangles == second.triangles;
  isopoint::forEffectiveOptions(first,
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
  return isopoint::runOn(surface, "surface",
    [&]()
    {
      isopoint::require(other, "other surface");
      if (surface == other || !areSame(surface->options, other->options) || !surface->isExtracted ||
          !other->isExtracted)
      {
        throw isopoint::UsageError(
          "Messages are joined of two surfaces of isopoint_extract() with the same options.");
      }
      if (surface->report.isovalues != other->report.isovalues)
      {
        throw isopoint::UsageError(
          "The surfaces have different isovalues. Extract them at the same.");
      }
      isopoint::Report joined = surface->report;
      joined.add(other->report);
      surface->messages = isopoint::describeReport(joined, isopoint::memberName);
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
  return isopoint::runOn(surface, "surface",
    [&]()
    {
      isopoint::require(array, "pointer to the array");
      *array = surface->array(array_id);
    });
}

isopoint_status isopoint_interpolate(
  const isopoint_surface* surface, const isopoint_array* of_samples, void* result, size_t size)
{
  return isopoint::runOn(
    surface, "surface", [&]() { surface->interpolate(of_samples, result, size); });
}

isopoint_status isopoint_create_surface(const isopoint_array* points, const isopoint_array* normals,
  const isopoint_array* axes, const isopoint_array* polygons, isopoint_surface** surface)
{
  return isopoint::runOn(surface, "pointer to the surface",
    [&]()
    {
      isopoint::Execution execution;
      isopoint::setThreads(execution, 0);
      *surface = new isopoint_surface(execution, points, normals, axes, polygons);
    });
}

isopoint_status isopoint_make_splat_mesh(isopoint_surface* surface, double scale)
{
  return isopoint::runOn(surface, "surface", [&]() { surface->makeSplatMesh(scale); });
}

isopoint_status isopoint_average_at_splat_vertices(
  const isopoint_surface* surface, const isopoint_array* of_points, void* result, size_t size)
{
  return isopoint::runOn(
    surface, "surface", [&]() { surface->averageAtSplatVertices(of_points, result, size); });
}
