// SPDX-License-Identifier: GPL-3.0-or-later
// Half-edges of meshes, and flips and collapses of edges.
#include "RandomClouds.h"
#include "Topology.h"

#include "Core/Triangles/FacetMesh.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace
{

using namespace isopoint;
using topology::Triangles;

const Execution execution;
const Vector up{ 0.0, 0.0, 1.0 };

/// A fan around vertex 0, in the plane, whose rim is 1 to 6.
struct Fan
{
  std::vector<Vector> positions;
  std::vector<Facet> facets;
  std::vector<bool> areInner = std::vector<bool>(8, true);

  explicit Fan(const Vector& center)
    : positions{ center, { 1.0, 0.0, 0.0 }, { 0.5, 0.9, 0.0 }, { -0.5, 0.9, 0.0 },
      { -1.0, 0.0, 0.0 }, { -0.5, -0.9, 0.0 }, { 0.5, -0.9, 0.0 } }
  {
    for (std::size_t i = 0; i < 6; ++i)
    {
      this->facets.push_back({ { 0, 1 + i, 1 + (i + 1) % 6 }, up });
    }
  }

  /// Adds a facet beyond the edge from 1 to 2.
  void addApex()
  {
    this->positions.push_back({ 1.2, 0.9, 0.0 });
    this->facets.push_back({ { 2, 1, 7 }, up });
  }

  FacetMesh mesh() const { return { execution, this->positions, this->areInner, this->facets }; }
};

// The center lies beyond the edge from 1 to 2.
const Vector beyond{ 0.85, 0.6, 0.0 };

double areaOf(const FacetMesh& mesh)
{
  double area = 0.0;
  for (const Facet& facet : mesh.facets())
  {
    area += mesh.signedArea(facet);
  }
  return area;
}

/// A torus of side x side squares, each of two triangles.
Triangles torusOf(std::size_t side)
{
  Triangles triangles;
  for (std::size_t i = 0; i < side * side; ++i)
  {
    const auto at = [&](std::size_t row, std::size_t column)
    { return (i / side + row) % side * side + (i + column) % side; };
    triangles.push_back({ i, at(1, 0), at(1, 1) });
    triangles.push_back({ i, at(1, 1), at(0, 1) });
  }
  return triangles;
}

Triangles remainingOf(const SurfaceMesh& mesh)
{
  Triangles triangles;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i)
  {
    if (!mesh.isRemoved(i))
    {
      triangles.push_back(mesh.triangles()[i]);
    }
  }
  return triangles;
}

/// Expects what follows from the corners alone, for all sides and vertices.
void expectConsistent(const SurfaceMesh& mesh)
{
  std::map<topology::Edge, std::vector<HalfEdge>> sidesOf; // by edge, the lower vertex first
  std::vector<std::set<HalfEdge>> outgoing(mesh.vertexCount());
  for (HalfEdge side = 0; side < 3 * mesh.triangles().size(); ++side)
  {
    if (!mesh.isRemoved(side / 3))
    {
      sidesOf[std::minmax({ mesh.startOf(side), mesh.endOf(side) })].push_back(side);
      outgoing[mesh.startOf(side)].insert(side);
    }
  }
  std::vector<bool> areOpen(mesh.vertexCount(), false);
  for (const auto& [edge, sides] : sidesOf)
  {
    const bool areTwins = sides.size() == 2 && mesh.startOf(sides[0]) == mesh.endOf(sides[1]);
    for (const HalfEdge side : sides)
    {
      const HalfEdge other = side == sides.front() ? sides.back() : sides.front();
      EXPECT_EQ(mesh.twinOf(side), areTwins ? other : noHalfEdge);
    }
    areOpen[edge.first] = areOpen[edge.first] || !areTwins;
    areOpen[edge.second] = areOpen[edge.second] || !areTwins;
    EXPECT_TRUE(mesh.hasEdge(edge.first, edge.second));
    EXPECT_TRUE(mesh.hasEdge(edge.second, edge.first));
  }
  for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex)
  {
    std::multiset<HalfEdge> found;
    mesh.outgoing().forEachAt(vertex, [&](HalfEdge side) { found.insert(side); });
    EXPECT_EQ(found, std::multiset<HalfEdge>(outgoing[vertex].begin(), outgoing[vertex].end()));
    EXPECT_EQ(mesh.isOpen(vertex), areOpen[vertex]);
  }
}

/// Flips and collapses edges chosen at random while the mesh stays a surface.
void changeAtRandom(SurfaceMesh& mesh, clouds::Dice& dice, std::size_t count)
{
  for (std::size_t change = 0; change < count; ++change)
  {
    const HalfEdge side = dice(3 * mesh.triangles().size());
    if (mesh.isRemoved(side / 3) || mesh.twinOf(side) == noHalfEdge)
    {
      continue;
    }
    const std::size_t c = mesh.oppositeOf(side);
    const std::size_t d = mesh.oppositeOf(mesh.twinOf(side));
    const std::vector<std::size_t> own = mesh.neighborsOf(mesh.startOf(side));
    const std::size_t common = clouds::sumOf(
      own, [&](std::size_t vertex) { return mesh.hasEdge(vertex, mesh.endOf(side)) ? 1.0 : 0.0; });
    if (dice(4) > 0 && c != d && !mesh.hasEdge(c, d))
    {
      mesh.flip(side);
      mesh.rotateCorners(side / 3);
    }
    else if (common == 2 && own.size() >= 4 && !mesh.isOpen(mesh.startOf(side)))
    {
      mesh.collapse(side);
    }
  }
}

} // namespace

TEST(SurfaceMesh, StaysConsistentWhenEdgesAreFlippedAndCollapsed)
{
  clouds::Dice dice(1);
  Triangles open = torusOf(9);
  open.erase(open.begin(), open.begin() + 20);
  for (const Triangles& triangles : { torusOf(9), open })
  {
    SurfaceMesh mesh(execution, triangles, 81);
    expectConsistent(mesh);
    const topology::Topology expected = topology::topologyOf(triangles);
    for (int round = 0; round < 20; ++round)
    {
      changeAtRandom(mesh, dice, 20);
      expectConsistent(mesh);
      EXPECT_EQ(topology::topologyOf(remainingOf(mesh)), expected);
    }
    EXPECT_LT(remainingOf(mesh).size(), triangles.size());
  }
}

TEST(SurfaceMesh, TellsDisksFromWhatIsNone)
{
  using Fan = SurfaceMesh::Fan;
  const auto fanAtFirst = [](const Triangles& triangles)
  {
    const SurfaceMesh mesh(execution, triangles, 12);
    expectConsistent(mesh);
    return mesh.fanAt(0);
  };
  EXPECT_EQ(fanAtFirst(torusOf(3)), Fan::Closed);
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } }), Fan::Closed);
  EXPECT_EQ(fanAtFirst({ { 0, 2, 3 }, { 0, 1, 2 }, { 0, 3, 4 } }), Fan::Open);
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 } }), Fan::Open);
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 2, 1 } }), Fan::BackToBack);
  EXPECT_EQ(fanAtFirst({ { 1, 2, 3 } }), Fan::Branched);
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 3, 4 } }), Fan::Branched);
  // An edge of three triangles, and one whose triangles disagree on its direction.
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 3, 1 }, { 0, 1, 4 } }), Fan::Branched);
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 1, 3 } }), Fan::Branched);
  // Four triangles at an edge, two in each direction: an isovalue at samples.
  EXPECT_EQ(fanAtFirst({ { 0, 1, 2 }, { 0, 3, 1 }, { 0, 1, 4 }, { 0, 5, 1 } }), Fan::Branched);
}

TEST(FacetMesh, AnEdgeIsFlippedWhereAFacetLooksTheWrongWay)
{
  Fan fan(beyond);
  FacetMesh mesh = fan.mesh();
  EXPECT_EQ(mesh.invertedFacets().size(), 1u);
  const double area = areaOf(mesh);
  mesh.untangle(); // the rim has no facets beyond: nothing can be flipped there
  EXPECT_NEAR(areaOf(mesh), area, 1e-12);
  fan.addApex();
  FacetMesh larger = fan.mesh();
  EXPECT_EQ(larger.invertedFacets().size(), 1u);
  larger.untangle();
  EXPECT_TRUE(larger.invertedFacets().empty());
  EXPECT_EQ(larger.facets().size(), fan.facets.size());
}

TEST(FacetMesh, EdgesAtTheBorderOfWhatIsKnownStay)
{
  Fan fan(beyond);
  fan.addApex();
  fan.areInner[7] = false;
  FacetMesh mesh = fan.mesh();
  mesh.untangle();
  EXPECT_EQ(mesh.invertedFacets().size(), 1u);
}

TEST(FacetMesh, AVertexIsMergedWithANeighbor)
{
  const Fan fan({ 0.0, 0.0, 0.0 });
  FacetMesh mesh = fan.mesh();
  const double area = areaOf(mesh);
  EXPECT_EQ(mesh.connectivity().neighborsOf(0), (std::vector<std::size_t>{ 1, 2, 3, 4, 5, 6 }));
  EXPECT_FALSE(mesh.collapse(0, 1, [](const Facet&) { return false; }));
  EXPECT_FALSE(mesh.collapse(1, 0, [](const Facet&) { return true; })) << "1 is at the border";
  EXPECT_TRUE(mesh.collapse(0, 1, [](const Facet&) { return true; }));
  EXPECT_EQ(mesh.facets().size(), 4u);
  EXPECT_NEAR(areaOf(mesh), area, 1e-12);
  EXPECT_TRUE(mesh.connectivity().neighborsOf(0).empty());
}

TEST(FacetMesh, ATetrahedronStaysOne)
{
  const std::vector<Vector> positions{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 0.0, 0.0, 1.0 } };
  const std::vector<bool> isInner(positions.size(), true);
  FacetMesh mesh(execution, positions, isInner,
    { { { 0, 2, 1 }, up }, { { 0, 1, 3 }, up }, { { 1, 2, 3 }, up }, { { 0, 3, 2 }, up } });
  mesh.untangle();
  EXPECT_FALSE(mesh.collapse(0, 1, [](const Facet&) { return true; }));
  EXPECT_EQ(mesh.facets().size(), 4u);
}

TEST(FacetMesh, FacetsBackToBackAreLeftAlone)
{
  const std::vector<Vector> positions{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  const std::vector<bool> isInner(positions.size(), true);
  FacetMesh mesh(execution, positions, isInner, { { { 0, 1, 2 }, up }, { { 1, 0, 2 }, up } });
  EXPECT_EQ(mesh.invertedFacets().size(), 1u);
  mesh.untangle();
  for (const Facet& facet : mesh.facets())
  {
    EXPECT_NE(facet.corners[0], facet.corners[1]);
    EXPECT_NE(facet.corners[1], facet.corners[2]);
    EXPECT_NE(facet.corners[2], facet.corners[0]);
  }
}
