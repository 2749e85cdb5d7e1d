// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatBorder_h
#define isopoint_SplatBorder_h

#include "Core/Base/Vector.h"
#include "Core/Neighbors/SampleExtent.h"
#include "Core/Splat/TangentCell.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

/// How far around itself a sample represents its surroundings, in spacings.
constexpr double sampleReach = 1.0;

/// How far a splat may reach out of the samples, in spacings.
constexpr double borderReach = 0.15;

/// Cells that reach farther, in spacings, may be large because points beyond were not found, or
/// because of a gap.
constexpr double largeReach = 1.27;

/// How far samples stand ahead of a place, in the sense of SampleExtents::at(), without those
/// across a gap.
/// @param isAcrossGap(sample, width) whether the void up to a sample, of this width, is a gap
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
  const Vector offset = difference(positionOf(*sample), query.place);
  ExtentQuery nearer = query;
  nearer.reach = std::nextafter(lengthOf(offset), 0.0);
  nearer.enough = std::min(query.enough, nearer.reach);
  const double before = extents.at(nearer);
  return isAcrossGap(*sample, dot(offset, query.direction) - before) ? before : extent;
}

/// Cuts off the parts of a point's cell that reach out of the samples: where the surface ends, a
/// cell may be bounded only by points along its border, far outside. In each of extentDirections()
/// it may reach `borderReach` farther than samples stand ahead of the point on this side of gaps;
/// the cell is bounded there. A closed cell is complete where it reaches no farther than
/// `sampleReach`.
/// @tparam TExtents SampleExtents, or another class with its at() and nearest()
/// @param extents null for none: then there is no border
/// @param normal of the point's splat, of length 1
/// @param spacing of the samples there, the unit of the cell; if it is not positive, no border is
/// known
/// @param isAcrossGap see extentUpToGaps()
template <class TExtents, class TIsAcrossGap>
void cutAtBorder(const TExtents* extents, const Vector& place, const Vector& normal, double spacing,
  const TIsAcrossGap& isAcrossGap, TangentCell& cell)
{
  constexpr double mostReach = 9.0; // of samples that count, in spacings
  const double complete = cell.isOpen() ? borderReach : sampleReach;
  if (!extents || !(spacing > 0.0) || !std::isfinite(mostReach * spacing) ||
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
      mostReach * spacing };
    const double extent =
      reach > largeReach ? extentUpToGaps(*extents, query, isAcrossGap) : extents->at(query);
    if (extent < query.enough)
    {
      cell.cut(direction, extent / spacing + borderReach, TangentCell::plane);
    }
  }
}

} // namespace isopoint

#endif
