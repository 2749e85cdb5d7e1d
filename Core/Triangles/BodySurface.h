// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Lists.h"
#include "Core/Triangles/BodyTetrahedra.h"
#include "Core/Triangles/ClosedMesh.h"
#include "Core/Triangles/CrossingVertices.h"
#include "Core/Triangles/SurfaceMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Makes the closed surface of a body: marching tetrahedra, and caps clipped at the isovalue.
template <class TSample>
class BodySurface
{
public:
  BodySurface(const Execution& execution, const SampleTree<TSample>& tree,
    LeafValues<TSample>& values, double isovalue, EdgeOrder order, const BodyTetrahedra& body)
    : Run(execution)
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
    const std::vector<std::size_t> order = this->pairsInOrder();
    const std::vector<std::size_t> pointOf = inverseOf(this->Run, order, order.size());
    const std::vector<std::size_t> pointOfVertex = tabulated<std::size_t>(this->Run, order.size(),
      [&](std::size_t pair) { return pointOf[this->Vertices.vertexOf(pair)]; });
    const ClosedTriangles closed =
      closedTriangles(this->Run, triangles, this->twinsOf(triangles), pointOfVertex, order.size());
    MarchedTriangles<TSample> result =
      this->Vertices.chosen(chosenOf(this->Run, order, closed.points));
    result.mesh.triangles = closed.triangles;
    result.mesh.caps = chosenOf(this->Run, closed.triangles,
      itemsThat(this->Run, closed.sources.size(),
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
      offsetsFromSizes(this->Run, crossingCount + this->Body.caps.size(),
        [&](std::size_t i)
        {
          return i < crossingCount ? (this->Body.crossing[i].belowCount == 2 ? 2 : 1)
                                   : triangleCountOf(this->Body.caps[i - crossingCount]);
        });
    this->FirstCap = begins[crossingCount];
    std::vector<SurfaceTriangle> triangles(begins.back());
    forEachIndex(this->Run, crossingCount,
      [&](std::size_t i) {
        this->setTriangles(this->Vertices.polygonOf(this->Body.crossing[i]), &triangles[begins[i]]);
      });
    this->SidesOfCaps.resize(this->Body.caps.size());
    forEachIndex(this->Run, this->Body.caps.size(),
      [&](std::size_t i)
      {
        const std::size_t first = begins[crossingCount + i];
        std::array<std::size_t, 3> beginsOfSides{};
        const Polygon polygon = this->Vertices.polygonOf(this->Body.caps[i], beginsOfSides);
        const std::size_t cut = this->setTriangles(polygon, &triangles[first]);
        for (std::size_t side = 0; side < 3; ++side)
        {
          // Two sides of each triangle of a quadrilateral are on the facet's sides.
          const std::size_t corner = (beginsOfSides[side] + polygon.count - cut) % polygon.count;
          this->SidesOfCaps[i][side] =
            3 * first + (polygon.count == 3 ? corner : corner + (corner >= 2 ? 1 : 0));
        }
      });
    return triangles;
  }

  /// A facet with one corner below is a quadrilateral.
  static int triangleCountOf(const CapFacet& cap)
  {
    return std::count(cap.areBelow.begin(), cap.areBelow.end(), true) == 1 ? 2 : 1;
  }

  /// @param triangles receives one or two
  /// @returns the corner in the polygon at which the first triangle begins
  std::size_t setTriangles(const Polygon& polygon, SurfaceTriangle* triangles) const
  {
    std::array<std::size_t, 4> corners{};
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      corners[i] = this->Vertices.numberOf(polygon.pairs[i]);
    }
    return this->Vertices.split(
      corners, polygon.count, [&](const SurfaceTriangle& each) { *triangles++ = each; });
  }

  /// Sides on an edge of the tetrahedralization belong to the same wedge as their twins. All others
  /// are the only two between their vertices.
  std::vector<HalfEdge> twinsOf(const std::vector<SurfaceTriangle>& triangles) const
  {
    const SurfaceMesh mesh(this->Run, triangles, this->Vertices.pairCount());
    std::vector<HalfEdge> twins = tabulated<HalfEdge>(
      this->Run, 3 * triangles.size(), [&](HalfEdge side) { return mesh.twinOf(side); });
    forEachIndex(this->Run, this->Body.caps.size(),
      [&](std::size_t i)
      {
        const CapFacet& cap = this->Body.caps[i];
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
  HalfEdge sideOn(std::size_t cap, std::size_t corner) const
  {
    const std::array<std::size_t, 3>& corners = this->Body.caps[cap].corners;
    return this->SidesOfCaps[cap][static_cast<std::size_t>(
      std::find(corners.begin(), corners.end(), corner) - corners.begin())];
  }

  /// The pairs in the order of their edges.
  std::vector<std::size_t> pairsInOrder() const
  {
    const std::size_t count = this->Vertices.pairCount();
    return this->Order == EdgeOrder::Tree ? iota(count)
                                          : orderOfEdges(this->Run, count,
                                              [this](std::size_t pair) -> const SampleEdge&
                                              { return this->Vertices.edges()[pair]; });
  }

  const Execution& Run;
  const EdgeOrder Order;
  const BodyTetrahedra& Body;
  CrossingVertices<TSample> Vertices;
  std::size_t FirstCap = 0;
  /// By cap and side of its facet, the part of it that is a side of a triangle.
  std::vector<std::array<HalfEdge, 3>> SidesOfCaps;
};

} // namespace isopoint
