// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Triangles/TriangleGeometry.h"
#include "Core/Triangles/VertexMerging.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// Triangles whose vertices have edges of the tetrahedralization.
template <class TSample>
struct EdgeTriangles
{
  /// The edge of each vertex. For a merged vertex, the edges of all crossings that it is the mean
  /// of, nearest first. One list after the other.
  std::vector<CrossingEdge<TSample>> edges;
  std::vector<std::size_t> edgeBegins;    // see Isosurface
  std::vector<Vector> positions;          // crossings, or their means
  std::vector<SurfaceTriangle> triangles; // ordered
  std::vector<SurfaceTriangle> caps;      // those of caps; ordered

  std::size_t edgeBegin(std::size_t vertex) const
  {
    return this->edgeBegins.empty() ? vertex : this->edgeBegins[vertex];
  }

  std::vector<CrossingEdge<TSample>> firstEdges(const Execution& execution) const
  {
    std::vector<CrossingEdge<TSample>> first(this->positions.size());
    forEachIndex(execution, first.size(),
      [&](std::size_t vertex) { first[vertex] = this->edges[this->edgeBegin(vertex)]; });
    return first;
  }

  /// By vertex, whether it is one of a cap.
  std::vector<char> areOfCaps(const Execution& execution) const
  {
    std::vector<char> marks(this->positions.size(), 0);
    forEachInOrder(execution, this->caps.size(),
      [&](std::size_t i)
      {
        for (const std::size_t vertex : this->caps[i])
        {
          marks[vertex] = 1;
        }
      });
    return marks;
  }

  /// The triangles of the isosurface.
  std::vector<SurfaceTriangle> withoutCaps(const Execution& execution) const
  {
    std::vector<SurfaceTriangle> others = this->triangles;
    dropMarked(execution, this->areCaps(execution), others);
    return others;
  }

  /// By triangle, whether it is one of a cap.
  std::vector<char> areCaps(const Execution& execution) const
  {
    std::vector<char> marks(this->triangles.size(), 0);
    forEachIndex(execution, marks.size(),
      [&](std::size_t i)
      {
        const bool isCap =
          std::binary_search(this->caps.begin(), this->caps.end(), this->triangles[i]);
        marks[i] = isCap ? 1 : 0;
      });
    return marks;
  }
};

/// Triangles whose vertices have one edge each, sorted by the edges' ends in the tree.
template <class TSample>
struct MarchedTriangles : EdgeTriangles<TSample>
{
  /// The nearer end of each edge, numbered by its place in the tree.
  std::vector<std::size_t> nearerEnds;
  std::size_t endCount = 0; // exceeds all of these numbers
};

/// See mergeVertices(). Vertices of caps stay. @throws std::bad_alloc, Aborted
template <class TSample>
EdgeTriangles<TSample> withMergedVertices(const Execution& execution,
  MarchedTriangles<TSample> marched, std::vector<char> areKept, bool keepsRim)
{
  const bool hasCaps = !marched.caps.empty();
  MergedTriangles merged = mergeVertices(execution, marched.positions, marched.nearerEnds,
    marched.endCount, std::move(marched.triangles),
    hasCaps ? marched.areOfCaps(execution) : std::move(areKept), keepsRim || hasCaps);
  EdgeTriangles<TSample> result;
  if (hasCaps)
  {
    std::vector<std::size_t> firsts(merged.size()); // members, the only ones of vertices that stay
    forEachIndex(execution, firsts.size(),
      [&](std::size_t vertex) { firsts[vertex] = merged.members[merged.memberBegins[vertex]]; });
    result.caps = renumbered(execution, marched.caps, firsts, marched.positions.size());
  }
  result.edges = chosenOf(execution, marched.edges, merged.members);
  result.edgeBegins = std::move(merged.memberBegins);
  result.positions = std::move(merged.positions);
  result.triangles = std::move(merged.triangles);
  return result;
}

/// The vertices sorted by their first edges. @throws std::bad_alloc, Aborted
template <class TSample>
std::vector<std::size_t> orderOfEdges(
  const Execution& execution, const EdgeTriangles<TSample>& triangles)
{
  struct EdgeVertex : SampleEdge
  {
    std::size_t vertex; // several can have one edge: see Isosurface

    bool operator<(const EdgeVertex& other) const
    {
      return SampleEdge::operator==(other) ? this->vertex < other.vertex
                                           : SampleEdge::operator<(other);
    }
    bool operator==(const EdgeVertex& other) const { return this->vertex == other.vertex; }
  };
  std::vector<EdgeVertex> vertices(triangles.positions.size());
  std::uint64_t most = 0;
  forEachInOrder(execution, vertices.size(),
    [&](std::size_t vertex)
    {
      vertices[vertex] = { triangles.edges[triangles.edgeBegin(vertex)], vertex };
      most = std::max(most, vertices[vertex].first);
    });
  vertices = sortedUnique(
    execution, vertices, most + 1, [](const EdgeVertex& vertex) { return vertex.first; });
  std::vector<std::size_t> order(vertices.size());
  forEachIndex(execution, order.size(), [&](std::size_t i) { order[i] = vertices[i].vertex; });
  return order;
}

/// Reorders the vertices. @throws std::bad_alloc, Aborted
template <class TSample>
EdgeTriangles<TSample> inOrder(const Execution& execution, const EdgeTriangles<TSample>& triangles,
  const std::vector<std::size_t>& order)
{
  EdgeTriangles<TSample> result;
  std::vector<std::size_t> edges;
  result.edgeBegins = chosenLists(execution, triangles.edgeBegins, order, edges);
  result.edges = chosenOf(execution, triangles.edges, triangles.edgeBegins.empty() ? order : edges);
  result.positions = chosenOf(execution, triangles.positions, order);
  result.triangles = renumbered(execution, triangles.triangles, order, order.size());
  result.caps = renumbered(execution, triangles.caps, order, order.size());
  return result;
}

} // namespace isopoint
