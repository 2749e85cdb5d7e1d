// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
  /// How much thin() drops, from 0 (nothing) to 1. Requires fits.
  double minimumSpacing = 0.0;
  std::optional<SplatOptions> splats = std::nullopt;
  /// Whether isopoints are the vertices of triangles: the isosurface of the Delaunay
  /// tetrahedralization of the samples (docs/triangles.md). Then angle and minimum spacing have no
  /// effect, and normals replace splats.
  bool triangles = false;
  /// On ranks: how many rings of other ranks' triangles to add; each has the triangles with a
  /// vertex in the part within. The same on all ranks.
  int ghostRings = 0;
};

/// Results for one isovalue.
struct ExtractedIsosurface
{
  Isosurface surface;
  std::vector<Splat> splats;              // one per isopoint, or empty if not requested
  std::vector<Vector> normals;            // one per vertex of triangles, or empty
  std::vector<SurfaceTriangle> triangles; // indices of isopoints; empty if not requested
  std::size_t ghostTriangles = 0;         // the last triangles, of other ranks
  /// Crossing edges, or tetrahedra, dropped in gaps. On ranks, each counts once.
  std::size_t droppedInGaps = 0;
  /// Per isopoint, whether it belongs to another rank; empty if none does.
  std::vector<bool> areElsewhere;

  /// The number of isopoints that belong to this rank.
  std::size_t countHere() const
  {
    return this->surface.size() - static_cast<std::size_t>(std::count(
                                    this->areElsewhere.begin(), this->areElsewhere.end(), true));
  }
};

} // namespace isopoint
