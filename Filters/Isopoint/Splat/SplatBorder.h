// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatBorder_h
#define isopoint_SplatBorder_h

#include "Isopoint/Base/TangentFrame.h"
#include "Isopoint/Base/Vector.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Splat/TangentCell.h"

#include <cmath>

namespace isopoint
{

/// How far around itself a sample represents its surroundings, in spacings.
constexpr double sampleReach = 0.9;

/// How far a splat may reach out of the samples, in spacings.
constexpr double borderReach = 0.15;

/// Cuts off the parts of a point's cell that reach out of the samples: where the surface ends, a
/// cell may be bounded only by points along its border, far outside. In each of extentDirections()
/// it may reach `borderReach` farther than samples stand ahead of the point; the new sides are
/// limits. A closed cell is complete where it reaches no farther than `sampleReach`.
/// @tparam TExtents SampleExtents, or another class with its at()
/// @param extents null for none: then there is no border
/// @param normal of the point's splat, of length 1
/// @param spacing of the samples there, the unit of the cell; if it is not positive, no border is
/// known
template <class TExtents>
void cutAtBorder(const TExtents* extents, const Vector& place, const Vector& normal, double spacing,
  TangentCell& cell)
{
  // How far away samples count, in spacings: a cell is as far from what is across a gap as it may
  // reach into it.
  constexpr double mostReach = 9.0;
  const double complete = cell.isOpen() ? borderReach : sampleReach;
  if (!extents || !(spacing > 0.0) || !std::isfinite(mostReach * spacing) ||
      cell.squaredReach() <= complete * complete)
  {
    return;
  }
  for (const Vector& direction : extentDirections(normal))
  {
    const double reach = cell.reachTowards(direction);
    if (reach <= complete)
    {
      continue;
    }
    const double wanted = reach - borderReach;
    const double extent =
      extents->at({ place, normal, direction, wanted * spacing, mostReach * spacing }) / spacing;
    if (extent < wanted)
    {
      cell.cut(direction, extent + borderReach, TangentCell::limit);
    }
  }
}

} // namespace isopoint

#endif
