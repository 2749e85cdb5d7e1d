// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"
#include "Core/Triangles/SurfaceMesh.h"
#include "Core/Triangles/VertexParts.h"

#include <cstddef>
#include <vector>

namespace isopoint
{

/// The rim between an isosurface and the caps that close it, for merging: vertices move along the
/// rim only, and none at its corners, so that caps keep their shape.
class CapRim
{
public:
  /// @param mesh closed if there are caps
  /// @param caps those of its triangles that are caps; ordered, maybe empty
  /// @param positions of its vertices
  /// @throws std::bad_alloc, Aborted
  CapRim(const Execution& execution, const SurfaceMesh& mesh,
    const std::vector<SurfaceTriangle>& caps, const std::vector<Vector>& positions);

  bool isCap(std::size_t triangle) const
  {
    return !this->AreCaps.empty() && this->AreCaps[triangle] != 0;
  }

  /// Whether a part may become one vertex: its rim, if any, is one path with at most one corner.
  bool isMergeable(const VertexParts& parts, std::size_t part) const;

  /// The vertex that a part becomes: on the rim, its corner, or else the one nearest to the
  /// mean. VertexParts::none for a part that is not on the rim.
  std::size_t vertexOf(const VertexParts& parts, std::size_t part) const;

private:
  enum class Kind : char
  {
    Off,
    Smooth,
    Corner // of the caps, or of several rims
  };

  bool isAt(HalfEdge side) const;
  Kind kindAt(std::size_t vertex) const;
  bool isSharp(std::size_t vertex) const;

  const SurfaceMesh& Mesh;
  const std::vector<Vector>& Positions;
  std::vector<char> AreCaps; // triangles; empty without caps
  std::vector<Kind> Kinds;   // of vertices; likewise
};

} // namespace isopoint
