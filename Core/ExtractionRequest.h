// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractionRequest_h
#define isopoint_ExtractionRequest_h

#include "Core/Extraction/Isosurface.h"
#include "Core/Splat/Splat.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// What to compute for one isovalue.
struct ExtractionRequest
{
  IsosurfaceRequest isosurface;
  /// How much of the isosurface thin() drops: 0, which drops nothing, up to 1. Takes effect if
  /// something is fitted.
  double minimumSpacing = 0.0;
  std::optional<SplatOptions> splats = std::nullopt;
  /// Whether the isopoints are to be the vertices of triangles: those of the isosurface of the
  /// Delaunay tetrahedrization of the samples (docs/triangles.md). The angle and the minimum
  /// spacing then have no effect, and normals take the place of splats.
  bool triangles = false;
  /// Of a cloud on ranks: how many rings of triangles of other ranks, all with a vertex in the part
  /// within, are added around those of this one. The same on all ranks.
  int ghostRings = 0;
};

/// All that is computed for one isovalue.
struct ExtractedIsosurface
{
  Isosurface surface;
  std::vector<Splat> splats;              // one for each isopoint, or empty if none were requested
  std::vector<Vector> normals;            // one for each vertex of triangles, or empty likewise
  std::vector<SurfaceTriangle> triangles; // numbers of isopoints; empty unless requested
  std::size_t ghostTriangles = 0;         // of these, the last ones: those of other ranks
  /// Crossing edges, or tetrahedra of triangles, that were left out since they lie in gaps. Of a
  /// cloud on ranks each is counted on one of them.
  std::size_t droppedInGaps = 0;
  /// Whether each isopoint is counted on another rank; empty if none is.
  std::vector<bool> areElsewhere;

  /// The number of isopoints that are counted on this rank.
  std::size_t countHere() const
  {
    return this->surface.size() - static_cast<std::size_t>(std::count(
                                    this->areElsewhere.begin(), this->areElsewhere.end(), true));
  }
};

} // namespace isopoint

#endif
