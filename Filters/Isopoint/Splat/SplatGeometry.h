// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Splat/NearestPositions.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatNormals.h"
#include "Isopoint/Splat/SplatShaper.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// Normals and shapes of splats for the points of one surface.
///
/// The normal is against the gradient of the point's fit, or, where none held or planes are
/// requested, that of PlaneNormals. Points at one position count as one among the nearest.
///
/// A splat covers the point's cell: the part of its tangent plane that is nearer to it than to
/// other points. Those without a smooth fit are left out within half a spacing of a point with one.
/// Together the cells leave no gap on a flat surface; a tenth is added for those that bend, up to a
/// fifth where they bend much or no fit determines the curvature. A cell reaches no farther than
/// two and a half spacings of the samples around the edge (half its length where no fits are given;
/// at most 0.8 times the distance of the 12th nearest point). Where other points do not bound it,
/// it may reach four and a half, not limited by the 12th, if a fit describes a smooth surface and
/// points of its own sheet stand all around, as between samples in lines; or else 1.2, as at a
/// border, and one where no fit held: an isolated point does not become a plate. A cell that
/// reaches out of the samples (see SplatBorder) is cut there and counts as one that nothing bounds.
/// Nor does it reach farther than the surface's radius of curvature, so that splats of a small blob
/// do not stick out of it.
///
/// Where the fits of two points found a crease between them, their cells do not end halfway but at
/// the other side's plane, and their splats are clipped there. Other cells end halfway, but not
/// on this side of the crease; their splats are clipped if two points across it agree on the plane.
///
/// @param extents of the samples, or null: then no border is known; see SplatBorder
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n log n) in all, and for each point O(neighborCount log n) and what its few
/// requests of extents take.
template <class TExtents>
std::vector<Splat> computeSplats(const Execution& execution, const SurfacePoints& points,
  const TExtents* extents, const SplatOptions& options)
{
  std::vector<Splat> splats(points.positions.size());
  const std::vector<std::size_t> unfitted = setFieldNormals(points, options, splats);
  if (unfitted.empty() && !options.shapes)
  {
    execution.progress(1.0);
    return splats;
  }
  const NearestPositions nearest(points.positions);
  throwIfAborted(execution);

  const double normalsShare = options.shapes ? 0.4 : 1.0;
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  forBatches(
    execution, unfitted.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      PlaneNormals planes(nearest, points.positions, points.decreasingEdges,
        static_cast<std::size_t>(options.neighborCount));
      for (std::size_t i = begin; i < end; ++i)
      {
        splats[unfitted[i]].normal = planes.at(unfitted[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare * share); });
  forBatches(
    execution, options.shapes ? splats.size() : 0, batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      SplatShaper<TExtents> shaper(nearest, points, extents, splats);
      for (std::size_t i = begin; i < end; ++i)
      {
        shaper.shape(i, splats[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare + (1.0 - normalsShare) * share); });
  return splats;
}

} // namespace isopoint

#endif
