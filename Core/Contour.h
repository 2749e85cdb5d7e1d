// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Contour_h
#define isopoint_Contour_h

#include "Core/Base/Execution.h"
#include "Core/Base/Team.h"
#include "Core/IsosurfaceExtractor.h"
#include "Core/Options.h"
#include "Core/Report.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// What the types of a cloud's positions and values hold. A cloud of several arrays, or on several
/// ranks, has what all of them have.
struct SampleTypes
{
  bool areFloatPositions = false; // float holds all positions exactly
  bool areFloatValues = false;    // and all values: float, and integers of two bytes or one
  bool areIntegers = false;       // values are rounded to integers

  /// What both hold. Collective.
  SampleTypes sharedBy(Team& team) const
  {
    return { !team.isAny(!this->areFloatPositions), !team.isAny(!this->areFloatValues),
      !team.isAny(!this->areIntegers) };
  }
};

/// Loads samples in the narrowest layout for their types. If the extractor holds the same positions
/// already, only the values are replaced, and the tree is kept. Throws what
/// IsosurfaceExtractor::load() does.
/// @param team null for one process; collective otherwise
/// @param types of all ranks
/// @param read see IsosurfaceExtractor::load()
template <class Reader>
void loadOrReplace(const Execution& execution, Team* team, IsosurfaceExtractor& extractor,
  const SampleTypes& types, std::size_t count, const Reader& read)
{
  // A rank alone may have dropped its samples, as for lack of memory.
  const bool areHeld = !team || !team->isAny(extractor.isOnRanks() != (team->size() > 1));
  const auto load = [&](auto coordinate, auto value)
  {
    using Coordinate = decltype(coordinate);
    using Value = decltype(value);
    if (areHeld && extractor.replaceValues<Coordinate, Value>(execution, count, read))
    {
      return;
    }
    team ? extractor.load<Coordinate, Value>(execution, *team, count, read)
         : extractor.load<Coordinate, Value>(execution, count, read);
  };
  types.areFloatPositions ? (types.areFloatValues ? load(0.0f, 0.0f) : load(0.0f, 0.0))
                          : (types.areFloatValues ? load(0.0, 0.0f) : load(0.0, 0.0));
  execution.progress(1.0);
  // The standard error of numbers that are rounded to integers.
  extractor.setValueError(types.areIntegers ? 1.0 / std::sqrt(12.0) : 0.0);
}

/// Extracts all isovalues of a report from the samples that are loaded, and counts in the report.
/// Throws what IsosurfaceExtractor::extract() does.
/// @param options effective ones
/// @param ghostRings of a cloud on ranks: rings of triangles, or whether isopoints around those of
/// this rank are wanted; see ExtractionRequest
/// @returns one surface for each isovalue, then, if there are any, the ghosts of each
std::vector<ExtractedIsosurface> extractIsovalues(const Execution& execution,
  IsosurfaceExtractor& extractor, const Options& options, int ghostRings, Report& report);

} // namespace isopoint

#endif
