// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Neighbors/ExtentQuery.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Base/Vector.h"

#include <array>
#include <vector>

namespace isopoint
{

constexpr int defaultNeighborCount = 12;

/// How a point of the surface is drawn, in the units of the positions.
struct Splat
{
  Vector normal; // of length 1
  double radius; // half the longer axis, positive
  Vector axis1;  // half-axes of an ellipse, axis1 x axis2 along the normal, axis1 the longer
  Vector axis2;
  /// a, b, c, d, e: of a splat at the point q only the places p with (a, b, c) . (p - q) + d >= 0
  /// are to be drawn, (a, b, c) of length 1, d >= 0; at that plane the surface turns to the
  /// normal's side (e = 1) or to the other (e = -1); all 0 where nothing is to be cut
  std::array<double, 5> clip;
};

/// The points of one surface, one entry each.
struct SurfacePoints
{
  std::vector<Vector> positions;
  /// Along its edge, from the end that is not below the isovalue to the one that is, of the edge's
  /// length.
  std::vector<Vector> decreasingEdges;
  std::vector<LocalFit> fits; // or none
  SampleExtents extents;      // of the samples, or none: then no border is known
};

/// How normals are found, and whether more is wanted.
struct SplatOptions
{
  int neighborCount =
    defaultNeighborCount;   // nearest positions a plane is fitted through, 3 or more
  bool fieldNormals = true; // the fits' gradients, where fits held
  bool shapes = true;       // or normals alone: everything else of the splats is 0
};

/// Normals and shapes of splats for the points of one surface.
///
/// The normal is against the gradient of the point's fit, or, where none held or planes are asked
/// for, that of PlaneNormals. Points at one position count as one among the nearest.
///
/// A splat covers the point's cell: the part of its tangent plane that is nearer to it than to
/// other points. Those without a smooth fit are left out within half a spacing of a point with one.
/// Together the cells leave no gap on a flat surface; a tenth is added for those that bend, up to a
/// fifth where they bend much or no fit tells how they do. A cell reaches no farther than two and a
/// half spacings of the samples around the edge (half its length where no fits are given; at most
/// 0.8 times the distance of the 12th nearest point). Where other points do not bound it, it may
/// reach four and a half, and those are not limited by the 12th, if a fit tells of a smooth surface
/// and points of its own sheet stand all around, as between samples in lines; or else 1.2, as at a
/// border, and one where no fit tells of a surface: an isolated point does not become a plate. A
/// cell that reaches out of the samples (see SplatBorder) is cut there and counts as one that
/// nothing bounds. Nor does it reach farther than the radius of the surface's curvature, so that
/// splats of a small blob do not stick out of it.
///
/// Where the fits of two points tell of a crease between them, their cells do not end halfway but
/// at the other side's plane, and so are their splats to be clipped. A cell of another fit ends
/// halfway to a point of a crease's other side, but not before it; its splat is to be clipped where
/// two points there agree on the plane.
///
/// @throws std::bad_alloc, Aborted; progress is told
/// Complexity: O(n log n) in all, and for each point O(neighborCount log n) and what its few
/// queries of the samples take.
std::vector<Splat> computeSplats(
  const Execution& execution, const SurfacePoints& points, const SplatOptions& options);

} // namespace isopoint

#endif
