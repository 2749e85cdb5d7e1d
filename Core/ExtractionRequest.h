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
  std::optional<SplatOptions> splats = std::nullopt;
  /// Whether isopoints are the vertices of triangles: the isosurface of the Delaunay
  /// tetrahedralization of the samples (docs/triangles.md). Then the angle has no effect, and
  /// normals replace splats.
  bool triangles = false;
  /// On ranks: how many rings of other ranks' triangles to add. Each ring consists of the triangles
  /// that share a vertex with the part inside it. The same on all ranks.
  int triangleGhostRings = 0;
};

/// Results for one isovalue.
struct ExtractedIsosurface
{
  Isosurface surface;
  std::vector<Splat> splats;              // one per isopoint, or empty if not requested
  std::vector<Vector> normals;            // one per vertex of triangles, or empty
  std::vector<SurfaceTriangle> triangles; // indices of isopoints; empty if not requested
  std::vector<char> areCaps;              // by triangle; empty without caps
  std::size_t ghostTriangles = 0;         // the last triangles, of other ranks
  /// Crossing edges, or tetrahedra, dropped in gaps. On ranks, each counts once.
  std::size_t droppedInGaps = 0;
  /// Per isopoint, whether it belongs to another rank; empty if none does.
  std::vector<bool> areGhosts;

  /// The number of isopoints that belong to this rank.
  std::size_t countHere() const
  {
    return this->surface.size() - static_cast<std::size_t>(std::count(
                                    this->areGhosts.begin(), this->areGhosts.end(), true));
  }
};

} // namespace isopoint
