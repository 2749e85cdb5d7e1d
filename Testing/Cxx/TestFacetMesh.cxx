// SPDX-License-Identifier: GPL-3.0-or-later
// Flips and collapses of edges on small meshes.
#include "Core/Triangles/FacetMesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{

using namespace isopoint;

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

} // namespace

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
  EXPECT_EQ(mesh.neighborsOf(0), (std::vector<std::size_t>{ 1, 2, 3, 4, 5, 6 }));
  EXPECT_FALSE(mesh.collapse(0, 1, [](const Facet&) { return false; }));
  EXPECT_FALSE(mesh.collapse(1, 0, [](const Facet&) { return true; })) << "1 is at the border";
  EXPECT_TRUE(mesh.collapse(0, 1, [](const Facet&) { return true; }));
  EXPECT_EQ(mesh.facets().size(), 4u);
  EXPECT_NEAR(areaOf(mesh), area, 1e-12);
  EXPECT_TRUE(mesh.neighborsOf(0).empty());
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
