// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Splat_h
#define isopoint_Splat_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/LocalFit.h"

#include <optional>
#include <vector>

namespace isopoint
{

/// How a point of the surface is drawn, in the units of the positions.
struct Splat
{
  Vector normal; // of length 1
  double radius; // half the longer axis, positive
  Vector axis1;  // half-axes of an ellipse, axis1 x axis2 along the normal, axis1 the longer
  Vector axis2;
  std::optional<CreasePlane> clip; // where a splat beside a crease ends
};

/// The points of one surface, one entry each.
struct SurfacePoints
{
  const std::vector<Vector>& positions;
  const std::vector<Vector>& decreasingEdges; // see Isosurface
  const std::vector<LocalFit>& fits;          // or empty
};

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
