// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Triangles/SurfaceTriangle.h"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace isopoint
{

/// A side of a triangle, counterclockwise: three times the number of the triangle, plus the number
/// of the corner at which the side begins.
using HalfEdge = std::size_t;

constexpr HalfEdge noHalfEdge = std::numeric_limits<HalfEdge>::max();

inline HalfEdge nextOf(HalfEdge side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

inline HalfEdge lastOf(HalfEdge side)
{
  return side % 3 == 0 ? side + 2 : side - 1;
}

/// The sides that begin at each vertex, ascending, so that sums over them have a defined order.
class OutgoingHalfEdges
{
public:
  /// O(vertices + triangles)
  /// @param vertexCount exceeds every vertex
  /// @throws std::bad_alloc, Aborted
  OutgoingHalfEdges(const Execution& execution, const std::vector<SurfaceTriangle>& triangles,
    std::size_t vertexCount);

  /// Calls visit(side) for the sides that begin at a vertex.
  template <class Visit>
  void forEachAt(std::size_t vertex, const Visit& visit) const
  {
    for (HalfEdge side = this->First[vertex]; side != noHalfEdge; side = this->Next[side])
    {
      visit(side);
    }
  }

  /// Whether a test is true for a side that begins at a vertex.
  template <class Test>
  bool anyAt(std::size_t vertex, const Test& test) const
  {
    HalfEdge side = this->First[vertex];
    while (side != noHalfEdge && !test(side))
    {
      side = this->Next[side];
    }
    return side != noHalfEdge;
  }

  /// The lowest side at a vertex, or noHalfEdge.
  HalfEdge firstAt(std::size_t vertex) const { return this->First[vertex]; }

  std::size_t vertexCount() const { return this->First.size(); }

  /// Puts a side first.
  void add(std::size_t vertex, HalfEdge side);
  void remove(std::size_t vertex, HalfEdge side);

private:
  std::vector<HalfEdge> First; // by vertex
  RawArray<HalfEdge> Next;     // of sides that begin at the same vertex
};

/// Triangles, which of their sides are one edge, and the sides at each vertex:
/// docs/architecture.md, "The mesh of triangles". Edges of one triangle (borders), and edges of
/// more than two or of two that disagree on its direction, have sides without twins. Several fans
/// can meet at a vertex. Functions on a vertex or side take O(triangles at the vertex or at the
/// side's ends).
class SurfaceMesh
{
public:
  /// Complexity: O(n log n) for the triangles at one vertex, linear in vertices and triangles
  /// @param vertexCount exceeds every vertex
  /// @throws std::bad_alloc, Aborted
  SurfaceMesh(
    const Execution& execution, std::vector<SurfaceTriangle> triangles, std::size_t vertexCount);

  const std::vector<SurfaceTriangle>& triangles() const { return this->Triangles; }
  std::vector<SurfaceTriangle> takeTriangles() && { return std::move(this->Triangles); }
  const OutgoingHalfEdges& outgoing() const { return this->Outgoing; }
  std::size_t vertexCount() const { return this->Outgoing.vertexCount(); }

  std::size_t startOf(HalfEdge side) const { return this->Triangles[side / 3][side % 3]; }
  std::size_t endOf(HalfEdge side) const { return this->startOf(nextOf(side)); }
  std::size_t oppositeOf(HalfEdge side) const { return this->startOf(lastOf(side)); }

  /// The side of the other triangle at an edge of exactly two, else noHalfEdge.
  HalfEdge twinOf(HalfEdge side) const { return this->Twins[side]; }

  /// Whether a side stands for its edge: one of two twins, or a side without.
  bool isFirst(HalfEdge side) const
  {
    return this->Twins[side] == noHalfEdge || side < this->Twins[side];
  }

  /// A side from one vertex to another, or noHalfEdge.
  HalfEdge halfEdgeBetween(std::size_t start, std::size_t end) const;

  bool hasEdge(std::size_t a, std::size_t b) const;

  /// Whether sides at a vertex have no twins.
  bool isOpen(std::size_t vertex) const { return this->AreOpen[vertex] != 0; }

  /// What the triangles at a vertex form.
  enum class Fan
  {
    Closed,     // a disk
    Open,       // half a disk
    BackToBack, // two triangles with the same corners
    Branched    // several fans, or none
  };
  Fan fanAt(std::size_t vertex) const;

  /// The other vertices of the triangles at a vertex, ascending.
  std::vector<std::size_t> neighborsOf(std::size_t vertex) const;

  /// Replaces the triangles (a, b, c) and (b, a, d) at a side ab with a twin by (c, a, d), in the
  /// place of the first, and (d, b, c). There must be no edge between c and d.
  void flip(HalfEdge side);

  /// Lets a triangle begin at its second corner.
  void rotateCorners(std::size_t triangle);

  /// Moves the start of a side onto its end and removes the side's two triangles. All sides at the
  /// start must have twins, and it must have exactly two neighbors in common with the end.
  void collapse(HalfEdge side);

  bool isRemoved(std::size_t triangle) const { return this->Triangles[triangle][0] == noHalfEdge; }

private:
  void findTwins(const Execution& execution);
  void setTwins(HalfEdge side, HalfEdge twin);
  void put(
    std::size_t triangle, const SurfaceTriangle& corners, const std::array<HalfEdge, 3>& twins);
  void remove(std::size_t triangle);

  std::vector<SurfaceTriangle> Triangles;
  RawArray<HalfEdge> Twins; // of sides
  OutgoingHalfEdges Outgoing;
  std::vector<char> AreOpen; // vertices
};

} // namespace isopoint
