// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Options.h"
#include "Core/Report.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The standard error of rounding to integers: 1 / sqrt(12).
constexpr double roundingError = 0.2886751345948129;

/// Properties of a cloud's positions and values. A cloud of several arrays, or on several ranks,
/// has a property if all of them have it.
struct SampleTypes
{
  bool areFloatPositions = false; // float holds all positions exactly
  bool areFloatValues = false; // float holds all values exactly: float, integers of up to two bytes
  bool areIntegers = false;    // values are rounded to integers

  /// The properties that all ranks have. Collective.
  SampleTypes sharedBy(ProcessGroup& processes) const
  {
    return { !processes.isAny(!this->areFloatPositions), !processes.isAny(!this->areFloatValues),
      !processes.isAny(!this->areIntegers) };
  }
};

/// Loads samples in the narrowest layout for their types. If the extractor holds the same
/// positions, replaces only the values and keeps the tree. Throws as IsosurfaceExtractor::load().
/// @param processes null for one process; otherwise collective
/// @param types of all ranks
/// @param read see IsosurfaceExtractor::load()
template <class Reader>
void loadOrReplace(const Execution& execution, ProcessGroup* processes,
  IsosurfaceExtractor& extractor, const SampleTypes& types, std::size_t count, const Reader& read)
{
  // One rank may have dropped its samples, for example for lack of memory.
  const bool areHeld =
    !processes || !processes->isAny(extractor.isOnRanks() != (processes->size() > 1));
  const auto load = [&](auto coordinate, auto value)
  {
    using Coordinate = decltype(coordinate);
    using Value = decltype(value);
    if (areHeld && extractor.replaceValues<Coordinate, Value>(execution, count, read))
    {
      return;
    }
    processes ? extractor.load<Coordinate, Value>(execution, *processes, count, read)
              : extractor.load<Coordinate, Value>(execution, count, read);
  };
  types.areFloatPositions ? (types.areFloatValues ? load(0.0f, 0.0f) : load(0.0f, 0.0))
                          : (types.areFloatValues ? load(0.0, 0.0f) : load(0.0, 0.0));
  execution.progress(1.0);
  extractor.setValueError(types.areIntegers ? roundingError : 0.0);
}

/// Extracts all isovalues of a report from the loaded samples, and counts in the report. Throws as
/// IsosurfaceExtractor::extract().
/// @param options effective ones
/// @param ghostRings on several ranks: how many rings of ghost triangles to add; for points, any
/// positive number requests ghosts
/// @returns one surface per isovalue; then, if requested, the ghosts of each
std::vector<ExtractedIsosurface> extractIsovalues(const Execution& execution,
  IsosurfaceExtractor& extractor, const Options& options, int ghostRings, Report& report);

} // namespace isopoint
