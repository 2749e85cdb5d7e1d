// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Triangles/BodyTetrahedra.h"
#include "Core/Triangles/ClosedMesh.h"
#include "Core/Triangles/CrossingVertices.h"
#include "Core/Triangles/EdgeTriangles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// Makes the closed surface of a body: marching tetrahedra, and caps clipped at the isovalue.
template <class TSample>
class BodySurface
{
public:
  using Id = typename TSample::Id;

  BodySurface(const Execution& execution, const SampleTree<TSample>& tree,
    LeafValues<TSample>& values, double isovalue, EdgeOrder order, const BodyTetrahedra<Id>& body)
    : Exec(execution)
    , Order(order)
    , Body(body)
    , Vertices(execution, tree, values, isovalue, order, body.crossing, body.caps)
  {
  }

  /// Complexity: O(n log n) @throws std::bad_alloc, Aborted
  MarchedTriangles<TSample> find()
  {
    this->Vertices.find();
    const std::vector<SurfaceTriangle> triangles = this->allTriangles();
    const std::vector<std::size_t> order = this->placesInOrder();
    std::vector<std::size_t> placeOf(this->Vertices.pairCount());
    forEachIndex(
      this->Exec, order.size(), [&](std::size_t place) { placeOf[order[place]] = place; });
    std::vector<std::size_t> placeOfVertex(placeOf.size());
    forEachIndex(this->Exec, placeOf.size(),
      [&](std::size_t pair) { placeOfVertex[pair] = placeOf[this->Vertices.vertexOf(pair)]; });
    const ClosedTriangles closed =
      closedTriangles(this->Exec, triangles, this->twinsOf(triangles), placeOfVertex, order.size());
    MarchedTriangles<TSample> result;
    const std::vector<std::size_t> pairs = chosenOf(this->Exec, order, closed.places);
    result.edges = chosenOf(this->Exec, this->Vertices.edges(), pairs);
    result.positions = chosenOf(this->Exec, this->Vertices.positions(), pairs);
    result.nearerEnds = chosenOf(this->Exec, this->Vertices.nearerEnds(), pairs);
    result.endCount = this->Vertices.endCount();
    result.triangles = closed.triangles;
    result.caps = chosenOf(this->Exec, closed.triangles,
      itemsThat(this->Exec, closed.sources.size(),
        [&](std::size_t i) { return closed.sources[i] >= this->FirstCap; }));
    return result;
  }

private:
  using Polygon = typename CrossingVertices<TSample>::Polygon;

  /// The triangles of the isosurface, then of the caps, with pairs as vertices.
  std::vector<SurfaceTriangle> allTriangles()
  {
    const std::size_t crossingCount = this->Body.crossing.size();
    const std::vector<std::size_t> begins =
      beginsOfLists(this->Exec, crossingCount + this->Body.caps.size(),
        [&](std::size_t i)
        {
          return i < crossingCount ? (this->Body.crossing[i].belowCount == 2 ? 2 : 1)
                                   : triangleCountOf(this->Body.caps[i - crossingCount]);
        });
    this->FirstCap = begins[crossingCount];
    std::vector<SurfaceTriangle> triangles(begins.back());
    forEachIndex(this->Exec, crossingCount,
      [&](std::size_t i) {
        this->setTriangles(this->Vertices.polygonOf(this->Body.crossing[i]), &triangles[begins[i]]);
      });
    this->SidesOfCaps.resize(this->Body.caps.size());
    forEachIndex(this->Exec, this->Body.caps.size(),
      [&](std::size_t i)
      {
        const std::size_t first = begins[crossingCount + i];
        std::array<std::size_t, 3> beginsOfSides{};
        const Polygon polygon = this->Vertices.polygonOf(this->Body.caps[i], beginsOfSides);
        const std::size_t cut = this->setTriangles(polygon, &triangles[first]);
        for (std::size_t side = 0; side < 3; ++side)
        {
          // Two sides of each triangle of a quadrilateral are on the facet's sides.
          const std::size_t place = (beginsOfSides[side] + polygon.count - cut) % polygon.count;
          this->SidesOfCaps[i][side] =
            3 * first + (polygon.count == 3 ? place : place + (place >= 2 ? 1 : 0));
        }
      });
    return triangles;
  }

  /// A facet with one corner below is a quadrilateral.
  static int triangleCountOf(const CapFacet<Id>& cap)
  {
    return std::count(cap.areBelow.begin(), cap.areBelow.end(), true) == 1 ? 2 : 1;
  }

  /// @param triangles receives one or two
  /// @returns the place in the polygon at which the first triangle begins
  std::size_t setTriangles(const Polygon& polygon, SurfaceTriangle* triangles) const
  {
    std::array<std::size_t, 4> corners{};
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      corners[i] = this->Vertices.numberOf(polygon.pairs[i]);
    }
    const std::size_t from = polygon.count == 4 && !this->Vertices.cutsFirst(corners) ? 1 : 0;
    const auto corner = [&](std::size_t i) { return corners[(from + i) % polygon.count]; };
    triangles[0] = { corner(0), corner(1), corner(2) };
    if (polygon.count == 4)
    {
      triangles[1] = { corner(2), corner(3), corner(0) };
    }
    return from;
  }

  /// Sides on an edge of the tetrahedralization belong to the same wedge as their twins. All others
  /// are the only two between their vertices.
  std::vector<HalfEdge> twinsOf(const std::vector<SurfaceTriangle>& triangles) const
  {
    const SurfaceMesh mesh(this->Exec, triangles, this->Vertices.pairCount());
    std::vector<HalfEdge> twins(3 * triangles.size());
    forEachIndex(this->Exec, twins.size(), [&](HalfEdge side) { twins[side] = mesh.twinOf(side); });
    forEachIndex(this->Exec, this->Body.caps.size(),
      [&](std::size_t i)
      {
        const CapFacet<Id>& cap = this->Body.caps[i];
        for (std::size_t side = 0; side < 3; ++side)
        {
          const std::size_t next = (side + 1) % 3;
          if (!cap.areBelow[side] || !cap.areBelow[next])
          {
            twins[this->SidesOfCaps[i][side]] = this->sideOn(cap.partners[side], cap.corners[next]);
          }
        }
      });
    return twins;
  }

  /// The side of a cap on the facet's side that begins at a corner.
  HalfEdge sideOn(std::size_t cap, Id corner) const
  {
    const std::array<Id, 3>& corners = this->Body.caps[cap].corners;
    return this->SidesOfCaps[cap][static_cast<std::size_t>(
      std::find(corners.begin(), corners.end(), corner) - corners.begin())];
  }

  /// The pairs in the order of their edges.
  std::vector<std::size_t> placesInOrder() const
  {
    if (this->Order == EdgeOrder::Tree)
    {
      std::vector<std::size_t> places(this->Vertices.pairCount());
      std::iota(places.begin(), places.end(), std::size_t{ 0 });
      return places;
    }
    EdgeTriangles<TSample> vertices;
    vertices.edges = this->Vertices.edges();
    vertices.positions = this->Vertices.positions();
    return orderOfEdges(this->Exec, vertices);
  }

  const Execution& Exec;
  const EdgeOrder Order;
  const BodyTetrahedra<Id>& Body;
  CrossingVertices<TSample> Vertices;
  std::size_t FirstCap = 0;
  /// By cap and side of its facet, the part of it that is a side of a triangle.
  std::vector<std::array<HalfEdge, 3>> SidesOfCaps;
};

} // namespace isopoint
