// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Splat_h
#define isopoint_Splat_h

#include "Core/Base/SplatNumbers.h"
#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Whether a point has a splat of its own.
enum class SplatState : char
{
  Undecided,
  Visible,
  Hidden // a visible point represents it
};

/// Corners of splats between two sides that were cut halfway to other points: the surface goes on
/// there.
struct SplatCornerCounts
{
  std::uint32_t inner = 0;
  std::uint32_t apart = 0; // of these, the ones that meet no others: a hole may be there
};

/// The part of the surface that is drawn for a point: the triangles between the point and each two
/// consecutive corners.
struct Splat
{
  Vector normal; // of length 1
  double radius; // the distance of the farthest corner
  Vector axis;   // t1, tangential and as long as the radius; t2 = normal x t1
  /// Counterclockwise seen from the tip of the normal, but for rare ones that have passed each
  /// other where cells meet. Further corners repeat the last one; all are 0 at a hidden point.
  SplatCorners corners;
  SplatCornerCounts counts;
};

/// The points of one surface, one entry each.
struct SurfacePoints
{
  const std::vector<Vector>& positions;
  const std::vector<Vector>& decreasingEdges; // see Isosurface
  const std::vector<LocalFit>& fits;          // or empty

  /// Of points at one position the one of the lowest number counts, and of points at the same
  /// distance it comes first. Empty: they are numbered as listed.
  std::vector<std::size_t> numbers = {};

  double isovalue = 0.0;

  std::size_t numberOf(std::size_t point) const
  {
    return this->numbers.empty() ? point : this->numbers[point];
  }
};

/// The unit of length at a point: the samples' spacing or, where it is not known, half the length
/// of the point's edge.
inline double unitAt(const SurfacePoints& points, std::size_t point)
{
  const double spacing = points.fits.empty() ? 0.0 : points.fits[point].spacing;
  return spacing > 0.0 && std::isfinite(spacing) ? spacing
                                                 : 0.5 * lengthOf(points.decreasingEdges[point]);
}

/// Whether a fit held at a point that describes a smooth surface.
inline bool isSmoothAt(const SurfacePoints& points, std::size_t point)
{
  return !points.fits.empty() && points.fits[point].isSmooth;
}

constexpr int defaultNeighborCount = 12;

/// How normals are found, and whether shapes are wanted.
struct SplatOptions
{
  int neighborCount =
    defaultNeighborCount;   // nearest positions that a plane is fitted through, 3 or more
  bool fieldNormals = true; // the fits' gradients, where fits held
  bool shapes = true;       // or normals alone: everything else of the splats is 0
};

} // namespace isopoint

#endif
