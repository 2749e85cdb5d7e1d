// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// The connected parts of groups of vertices, along edges of triangles, without single vertices.
class VertexParts
{
public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// @param groups of the vertices, below groupCount
  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(triangles + groups), and O(n log n) for those within one group
  VertexParts(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
    const std::vector<std::size_t>& groups, std::size_t groupCount);

  std::size_t size() const { return this->Parts.size(); }

  /// The part of a vertex, or none if it is alone. Parts are ordered by group and first vertex.
  std::size_t partOf(std::size_t vertex) const { return this->PartOf[vertex]; }

  IndexSpan<std::size_t> verticesOf(std::size_t part) const
  {
    const Part& own = this->Parts[part];
    return { this->Vertices.data() + own.begin, own.end - own.begin };
  }

  /// Whether a part is simply connected: vertices - edges + triangles = 1.
  bool isSimple(std::size_t part) const { return this->Parts[part].isSimple; }

  IndexSpan<std::size_t> trianglesAround(std::size_t part) const
  {
    return this->Triangles->at(part);
  }

private:
  struct Part
  {
    std::size_t begin; // among the vertices
    std::size_t end;
    bool isSimple;
  };

  class Labeling;

  std::vector<std::size_t> Vertices; // by group, and by part within
  std::vector<Part> Parts;
  std::vector<std::size_t> PartOf;
  std::optional<ItemLists> Triangles; // by part
};

} // namespace isopoint
