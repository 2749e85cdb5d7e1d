// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Neighbors/SampleExtent.h"
#include "Core/Splat/TangentPolygon.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

/// The radius that a sample represents, in spacings.
constexpr double sampleReach = 1.0;

/// How far a splat may extend beyond the samples, in spacings.
constexpr double borderReach = 0.15;

/// Cells that extend farther, in spacings, may be next to a gap or lack a neighbor.
constexpr double largeReach = 1.27;

/// The extent of the samples from a place, as SampleExtents::at(), up to the first gap.
/// @param isAcrossGap(sample, width) whether the void of this width before a sample is a gap
template <class TExtents, class TIsAcrossGap>
double extentUpToGaps(
  const TExtents& extents, const ExtentQuery& query, const TIsAcrossGap& isAcrossGap)
{
  const double extent = extents.at(query);
  const auto* const sample = extent < query.enough ? nullptr : extents.nearest(query);
  if (!sample)
  {
    return extent;
  }
  const Vector offset = positionOf(*sample) - query.position;
  ExtentQuery nearer = query;
  nearer.reach = std::nextafter(lengthOf(offset), 0.0);
  nearer.enough = std::min(query.enough, nearer.reach);
  const double before = extents.at(nearer);
  return isAcrossGap(*sample, dot(offset, query.direction) - before) ? before : extent;
}

/// Limits a cell to the samples: at the end of a surface, only distant points along its border may
/// bound a cell. In each of extentDirections(), the cell may extend `borderReach` beyond the
/// samples on this side of gaps. A closed cell is not cut within `sampleReach`.
/// @tparam TExtents SampleExtents, or another class with its at() and nearest()
/// @param extents null for no limit
/// @param normal of the point's splat, of length 1
/// @param spacing of the samples, the unit of the cell; no limit if not positive
/// @param isAcrossGap see extentUpToGaps()
template <class TExtents, class TIsAcrossGap>
void cutAtBorder(const TExtents* extents, const Vector& place, const Vector& normal, double spacing,
  const TIsAcrossGap& isAcrossGap, TangentPolygon& cell)
{
  constexpr double maxReach = 9.0; // samples farther away do not count; in spacings
  const double complete = cell.isOpen() ? borderReach : sampleReach;
  if (!extents || !(spacing > 0.0) || !std::isfinite(maxReach * spacing) ||
      cell.squaredReach() <= complete * complete)
  {
    return;
  }
  for (const Vector& direction : extentDirections(normal))
  {
    const double reach = cell.reach(direction);
    if (reach <= complete)
    {
      continue;
    }
    const ExtentQuery query{ place, normal, direction, (reach - borderReach) * spacing,
      maxReach * spacing };
    const double extent =
      reach > largeReach ? extentUpToGaps(*extents, query, isAcrossGap) : extents->at(query);
    if (extent < query.enough)
    {
      cell.cut(direction, extent / spacing + borderReach, TangentPolygon::plane);
    }
  }
}

} // namespace isopoint
