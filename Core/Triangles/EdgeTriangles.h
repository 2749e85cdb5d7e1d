// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Triangles/BodyOrientation.h"
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
};

/// Triangles whose vertices have one edge each, sorted by the edges' ends in the tree.
template <class TSample>
struct MarchedTriangles : EdgeTriangles<TSample>
{
  /// The nearer end of each edge, numbered by its place in the tree.
  std::vector<std::size_t> nearerEnds;
  std::size_t endCount = 0; // exceeds all of these numbers
};

/// See mergeVertices(). Vertices at samples stay. @throws std::bad_alloc, Aborted
template <class TSample>
EdgeTriangles<TSample> withMergedVertices(const Execution& execution,
  MarchedTriangles<TSample> marched, std::vector<char> areFixed, bool keepsRim)
{
  const bool isBody = !marched.caps.empty();
  if (isBody)
  {
    areFixed.resize(marched.edges.size());
    forEachIndex(execution, areFixed.size(),
      [&](std::size_t vertex) { areFixed[vertex] = marched.edges[vertex].isSample() ? 1 : 0; });
  }
  MergeableTriangles exact{ marched.positions, std::move(marched.triangles),
    std::move(marched.caps), std::move(marched.nearerEnds), marched.endCount, std::move(areFixed),
    keepsRim };
  MergedTriangles merged;
  if (isBody)
  {
    merged = mergeVertices(execution, exact);
    restoreInvertedPieces(execution, exact, merged);
  }
  else
  {
    merged = mergeVertices(execution, std::move(exact));
  }
  EdgeTriangles<TSample> result;
  result.edges = chosenOf(execution, marched.edges, merged.members);
  result.edgeBegins = std::move(merged.memberBegins);
  result.positions = std::move(merged.positions);
  result.triangles = std::move(merged.triangles);
  result.caps = std::move(merged.caps);
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
  const std::size_t count = triangles.positions.size();
  result.triangles = renumbered(execution, triangles.triangles, order, count);
  result.caps = renumbered(execution, triangles.caps, order, count);
  return result;
}

} // namespace isopoint
