// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_VertexParts_h
#define isopoint_VertexParts_h

#include "Core/Base/Execution.h"
#include "Core/Base/ItemLists.h"
#include "Core/Base/NodeList.h"
#include "Core/Triangles/TriangleGeometry.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace isopoint
{

/// The connected parts of groups of vertices: vertices of one group that edges of triangles connect
/// are of one part. Parts of a single vertex are left out.
class VertexParts
{
public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// @param groups of the vertices, below groupCount
  /// @throws std::bad_alloc, Aborted
  /// Complexity: O(triangles + groups), and O(n log n) of those within one group
  VertexParts(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
    const std::vector<std::size_t>& groups, std::size_t groupCount);

  std::size_t size() const { return this->Parts.size(); }

  /// The part of a vertex, or none if it is alone. Parts are numbered by group and first vertex.
  std::size_t partOf(std::size_t vertex) const { return this->PartOf[vertex]; }

  /// The vertices of a part, ascending.
  NodeList<std::size_t> verticesOf(std::size_t part) const
  {
    const Part& own = this->Parts[part];
    return { this->Vertices.data() + own.begin, own.end - own.begin };
  }

  /// Whether a part is simply connected: vertices - edges + triangles = 1.
  bool isSimple(std::size_t part) const { return this->Parts[part].isSimple; }

  /// The triangles with a vertex in a part, ascending.
  NodeList<std::size_t> trianglesAround(std::size_t part) const
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

#endif
