// SPDX-License-Identifier: GPL-3.0-or-later
// Regularized triangles: fewer and of better shape, with the topology of the exact surface.
#include "RandomClouds.h"
#include "Topology.h"

#include "Core/OutputArrays.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/ShortEdges.h"
#include "Core/Triangles/SurfaceMesh.h"
#include "Core/Triangles/VertexMerging.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;
using clouds::Cloud;
using clouds::withValuesOf;
using topology::distanceFromSphere;
using topology::Topology;
using topology::topologyOf;
using topology::Triangles;

ExtractedIsosurface trianglesOf(const Cloud& cloud, double isovalue, bool regularizes,
  std::optional<FitOrder> order = std::nullopt, std::size_t threads = 1)
{
  return clouds::extracted(
    cloud, clouds::withTriangles(clouds::requestOf(isovalue, order), regularizes), threads);
}

/// Expects that regularized triangles have the topology of the exact ones. @returns that
Topology expectSameTopology(
  const Cloud& cloud, double isovalue, std::optional<FitOrder> order = std::nullopt)
{
  const Topology exact = topologyOf(trianglesOf(cloud, isovalue, false, order).triangles);
  EXPECT_EQ(topologyOf(trianglesOf(cloud, isovalue, true, order).triangles), exact);
  return exact;
}

double areaOf(const ExtractedIsosurface& extracted)
{
  return clouds::sumOf(extracted.triangles, [&](const SurfaceTriangle& triangle)
    { return 0.5 * lengthOf(topology::normalOf(extracted.surface.positions, triangle)); });
}

/// The smallest angle of each triangle in degrees, ascending.
std::vector<double> smallestAngles(const ExtractedIsosurface& extracted)
{
  std::vector<double> angles;
  const std::vector<Vector>& p = extracted.surface.positions;
  const auto angleAt = [](const Vector& a, const Vector& b, const Vector& c)
  {
    const Vector u = b - a;
    const Vector v = c - a;
    return std::atan2(lengthOf(cross(u, v)), dot(u, v)) * 57.29577951;
  };
  for (const auto& [a, b, c] : extracted.triangles)
  {
    angles.push_back(std::min(
      { angleAt(p[a], p[b], p[c]), angleAt(p[b], p[c], p[a]), angleAt(p[c], p[a], p[b]) }));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// A ball's surface: two poles, and a ring of nine vertices around its axis.
struct Bipyramid
{
  std::vector<Vector> positions{ { 0.0, 0.0, 1.0 }, { 0.0, 0.0, -1.0 } };
  Triangles triangles;

  Bipyramid()
  {
    for (std::size_t i = 0; i < 9; ++i)
    {
      const double angle = 6.283185307 * static_cast<double>(i) / 9.0;
      this->positions.push_back({ std::cos(angle), std::sin(angle), 0.0 });
      const std::size_t next = (i + 1) % 9;
      this->triangles.push_back({ 0, 2 + i, 2 + next });
      this->triangles.push_back({ 1, 2 + next, 2 + i });
    }
    std::sort(this->triangles.begin(), this->triangles.end());
  }
};

/// Flips edges of four vertices.
Triangles flipped(const std::vector<Vector>& positions, Triangles triangles)
{
  flipEdges({}, positions, std::vector<char>(positions.size(), 0), triangles);
  return triangles;
}

} // namespace

TEST(Regularization, HasAboutOneWellShapedTriangleFanForEachSample)
{
  const Cloud cloud = withValuesOf(clouds::uniform(100000, 1), distanceFromSphere);
  const ExtractedIsosurface exact = trianglesOf(cloud, 0.0, false, FitOrder::Cubic);
  const ExtractedIsosurface found = trianglesOf(cloud, 0.0, true, FitOrder::Cubic);
  EXPECT_LT(found.triangles.size(), exact.triangles.size() * 3 / 10);
  EXPECT_EQ(topologyOf(found.triangles), topologyOf(exact.triangles));
  const std::vector<double> angles = smallestAngles(found);
  EXPECT_GT(angles[angles.size() / 20], 20.0);
  EXPECT_GT(angles[angles.size() / 2], 36.0);
  EXPECT_GT(angles[angles.size() / 200], 10.0);
  EXPECT_LT(clouds::largestOf(found.surface.positions,
              [](const Vector& p) { return std::abs(distanceFromSphere(p)); }),
    1e-4);
}

/// Vertices beside creases are merged too, and none of them leaves its crease.
TEST(Regularization, CreasesStaySharp)
{
  const auto cube = [](const Vector& p) {
    return std::max({ std::abs(p[0] - 0.5), std::abs(p[1] - 0.5), std::abs(p[2] - 0.5) }) - 0.3;
  };
  const Cloud cloud = withValuesOf(clouds::uniform(60000, 1), cube);
  const ExtractedIsosurface exact = trianglesOf(cloud, 0.0, false, FitOrder::Crease);
  const ExtractedIsosurface found = trianglesOf(cloud, 0.0, true, FitOrder::Crease);
  EXPECT_LT(found.triangles.size(), exact.triangles.size() * 35 / 100);
  EXPECT_EQ(topologyOf(found.triangles), topologyOf(exact.triangles));
  const std::vector<double> angles = smallestAngles(found);
  EXPECT_GT(angles[angles.size() / 20], 8.0);
  EXPECT_GT(angles[angles.size() / 2], 30.0);
  EXPECT_NEAR(areaOf(found), areaOf(exact), 1e-3 * areaOf(exact));
  EXPECT_NEAR(areaOf(found), 6.0 * 0.6 * 0.6, 0.005);
}

/// Of lattices, duplicates, lines, sheets, noise, with and without fits and creases.
TEST(Regularization, KeepsTheTopologyOfAnyCloud)
{
  const std::vector<std::optional<FitOrder>> orders{ std::nullopt, FitOrder::Cubic,
    FitOrder::Crease };
  std::size_t manifolds = 0;
  const std::uint64_t last = clouds::numberFrom("REGULARIZATION_SEEDS", 200);
  for (std::uint64_t seed = 1; seed <= last; ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    Cloud cloud = clouds::randomCloud(dice, seed);
    if (seed % 4 == 0) // many of them have the isovalue
    {
      for (double& value : cloud.values)
      {
        value = 0.25 * static_cast<double>(dice(4));
      }
    }
    const double isovalue = seed % 4 == 0 ? 0.5 : 0.3 + 0.4 * dice.real();
    const Topology exact = expectSameTopology(cloud, isovalue, orders[seed % orders.size()]);
    manifolds += exact.isManifold && exact.components > 0 ? 1 : 0;
  }
  EXPECT_GT(manifolds, last / 4);
}

/// Few samples, many of them of the isovalue: sheets that touch in a vertex or share an edge.
TEST(Regularization, KeepsTheTopologyWhereSheetsMeet)
{
  std::size_t branched = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    Cloud cloud;
    for (std::size_t left = 6 + dice(6); left > 0; --left)
    {
      const auto below = [&](std::size_t limit) { return static_cast<double>(dice(limit)); };
      const Vector position{ below(6), below(6), below(6) };
      cloud.add(position, below(3) - 1.0);
    }
    branched += expectSameTopology(cloud, 0.0).isManifold ? 0 : 1;
  }
  EXPECT_GT(branched, 10u);
}

/// Values that are tiny beside their neighbors': from one end of an edge the crossing is at the
/// other end, seen from there it is not.
TEST(Regularization, CrossingsAtSamplesDoNotDependOnTheOrderOfSamples)
{
  Cloud cloud;
  cloud.add(-1, -1, 0, 0.0);
  cloud.add(0, -1, 1, -1.0);
  cloud.add(0, 1, -2, -1e-20);
  cloud.add(2, 0, -2, 1.0);
  cloud.add(2, 2, 1, 1.0);
  for (const bool regularizes : { false, true })
  {
    EXPECT_EQ(trianglesOf(cloud, 0.0, regularizes).triangles.size(),
      trianglesOf(clouds::permuted(cloud, { 4, 3, 2, 1, 0 }), 0.0, regularizes).triangles.size());
  }
}

TEST(Regularization, HugeCoordinatesHaveMeans)
{
  const Cloud cloud = withValuesOf(clouds::uniform(2000, 5), distanceFromSphere);
  const ExtractedIsosurface found =
    trianglesOf(clouds::scaled(cloud, 0x1p1022, 0x1p1022, 0x1p1022), 0.0, true);
  ASSERT_GT(found.surface.size(), 100u);
  for (const Vector& position : found.surface.positions)
  {
    EXPECT_TRUE(isFinite(position));
  }
}

/// With and without gaps, which the spacing of the samples decides.
TEST(Regularization, TrianglesAreTheSameAtAllScales)
{
  const Cloud uniform = clouds::uniform(1500, 6);
  const Cloud hollow = clouds::filtered(uniform,
    [](const Vector& p) {
      return lengthOf(p - Vector{ 0.3, 0.5, 0.5 }) > 0.25;
    });
  const auto found = [](const Cloud& cloud, const ExtractionRequest& request, double scale)
  { return clouds::extracted(clouds::scaled(cloud, scale, scale, scale), request); };
  for (const Cloud& cloud : { uniform, hollow })
  {
    for (const bool dropsGaps : { false, true })
    {
      const ExtractionRequest request =
        clouds::withTriangles(clouds::requestOf(0.3, FitOrder::Cubic, dropsGaps), true);
      const ExtractedIsosurface expected = found(cloud, request, 1.0);
      ASSERT_GT(expected.triangles.size(), 300u);
      // Near 1e77, 1e100, 1e160, 1e300 and their inverses.
      for (const int exponent : { 256, 332, 532, 1000, -256, -332, -532, -1000 })
      {
        SCOPED_TRACE(exponent);
        EXPECT_EQ(found(cloud, request, std::ldexp(1.0, exponent)).triangles, expected.triangles);
      }
    }
  }
}

/// One far vertex does not make the edges of all others vanish.
TEST(Regularization, FarVerticesChangeNothingElse)
{
  std::vector<Vector> positions{ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } };
  Triangles triangles{ { 0, 1, 2 }, { 0, 2, 3 } };
  for (const double far : { 1e300, 1.1e300 })
  {
    const std::size_t first = positions.size();
    positions.insert(positions.end(), { { 0, 0, far }, { far, 0, far }, { 0, far, far } });
    triangles.push_back({ first, first + 1, first + 2 });
  }
  triangles.insert(triangles.begin() + 2, { { 10, 11, 12 } });
  positions.insert(positions.end(), { { 9, 0, 0 }, { 9, 1, 0 }, { 8, 1, 0 } });
  const Triangles found = flipped(positions, triangles);
  EXPECT_NE(std::find(found.begin(), found.end(), SurfaceTriangle{ 0, 1, 3 }), found.end());
}

/// Questions are as frequent as triangles are processed, in every step.
TEST(Regularization, EveryStepAsksForAborts)
{
  constexpr std::size_t side = 182;
  clouds::Random random(9);
  std::vector<Vector> positions;
  Triangles triangles;
  for (std::size_t i = 0; i < side * side; ++i)
  {
    const auto row = static_cast<double>(i / side);
    const auto column = static_cast<double>(i % side);
    positions.push_back({ row + 0.8 * random(), column + 0.8 * random(), 0.0 });
    if (i / side + 1 < side && i % side + 1 < side)
    {
      triangles.push_back({ i, i + side, i + side + 1 });
      triangles.push_back({ i, i + side + 1, i + 1 });
    }
  }
  constexpr std::size_t most = 16384; // triangles between two questions
  std::size_t asked = 0;
  Execution execution;
  execution.isAborted = [&asked]()
  {
    ++asked;
    return false;
  };
  const auto questionsOf = [&](const auto& step)
  {
    asked = 0;
    step();
    return asked;
  };
  const std::vector<char> areFixed(positions.size(), 0);
  const std::size_t onePass = triangles.size() / most;
  const SurfaceMesh mesh({}, triangles, positions.size());
  EXPECT_GE(
    questionsOf([&]() { SurfaceMesh(execution, triangles, positions.size()); }), 2 * onePass);
  EXPECT_GE(questionsOf([&]() { shortEdges(execution, positions, mesh); }), 2 * onePass);
  EXPECT_GE(questionsOf([&]() { verticesOf(execution, triangles, positions.size()); }), onePass);
  EXPECT_GE(questionsOf([&]() { ordered(execution, triangles, positions.size()); }), onePass);
  // Twins: two passes over sides, at least one round; normals; order.
  Triangles changed = triangles;
  EXPECT_GE(
    questionsOf([&]() { flipEdges(execution, positions, areFixed, changed); }), 11 * onePass);
  // The groups of the first merge, then three rounds of flips and merges.
  std::vector<std::size_t> groups(positions.size());
  std::transform(positions.begin(), positions.end(), groups.begin(),
    [](const Vector& p) { return static_cast<std::size_t>(p[0] / 3.0); });
  EXPECT_GE(questionsOf(
              [&]() {
                mergeVertices(execution, { positions, triangles, {}, groups, side });
              }),
    40 * onePass);
}

TEST(Regularization, DoesNotDependOnThreadsOrTheOrderOfSamples)
{
  const Cloud cloud = withValuesOf(clouds::uniform(20000, 2),
    [](const Vector& p) { return std::sin(9.0 * p[0]) + std::cos(8.0 * p[1]) + p[2]; });
  const Cloud permuted = clouds::permuted(cloud, clouds::randomOrder(cloud.size(), 3));
  using Corners = std::array<Vector, 3>;
  const auto contentsOf = [](const ExtractedIsosurface& extracted)
  {
    std::multiset<Corners> all;
    for (const SurfaceTriangle& triangle : extracted.triangles)
    {
      Corners corners;
      std::transform(triangle.begin(), triangle.end(), corners.begin(),
        [&](std::size_t vertex) { return extracted.surface.positions[vertex]; });
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.insert(corners);
    }
    return all;
  };
  for (const std::optional<FitOrder> fit :
    { std::optional<FitOrder>(), std::optional(FitOrder::Cubic) })
  {
    const ExtractedIsosurface expected = trianglesOf(cloud, 0.7, true, fit);
    ASSERT_GT(expected.triangles.size(), 1000u);
    const ExtractedIsosurface onThreads = trianglesOf(cloud, 0.7, true, fit, 3);
    EXPECT_EQ(onThreads.surface.positions, expected.surface.positions);
    EXPECT_EQ(onThreads.triangles, expected.triangles);
    EXPECT_EQ(contentsOf(trianglesOf(permuted, 0.7, true, fit)), contentsOf(expected));
  }
}

/// A vertex has the mean of its crossings' attributes: exact where these are linear.
TEST(Regularization, AttributesAreMeansOverCrossings)
{
  const Cloud cloud = withValuesOf(clouds::uniform(5000, 4), distanceFromSphere);
  const ExtractedIsosurface found = trianglesOf(cloud, 0.0, true);
  ASSERT_GT(found.surface.size(), 100u);
  std::vector<Vector> places(found.surface.size());
  interpolateComponents(
    {}, found.surface, 3,
    [&](std::uint64_t sample, int component)
    { return cloud.positions[3 * sample + static_cast<std::size_t>(component)]; },
    [&](std::size_t i, int component, double value)
    { places[i][static_cast<std::size_t>(component)] = value; });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_LT(lengthOf(places[i] - found.surface.positions[i]), 1e-12);
  }
}

/// A plane through a block ends at the block's faces, with its corners.
TEST(Regularization, BordersKeepTheirCorners)
{
  const Cloud cloud =
    withValuesOf(clouds::lattice(11, 11, 11), [](const Vector& p) { return p[2] + 0.3 * p[0]; });
  const ExtractedIsosurface exact = trianglesOf(cloud, 5.05, false);
  const ExtractedIsosurface found = trianglesOf(cloud, 5.05, true);
  EXPECT_LT(found.triangles.size(), exact.triangles.size() / 2);
  EXPECT_NEAR(areaOf(found), areaOf(exact), 1e-9);
  EXPECT_NEAR(areaOf(found), 100.0 * std::sqrt(1.09), 1e-9);
}

/// Two vertices of a tetrahedron would leave two triangles back to back.
TEST(Regularization, ATetrahedronStays)
{
  const std::vector<Vector> positions{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  const Triangles triangles{ { 0, 1, 3 }, { 0, 2, 1 }, { 0, 3, 2 }, { 1, 2, 3 } };
  const CrossingMesh merged = mergeVertices({}, { positions, triangles, {}, { 0, 0, 1, 2 }, 3 });
  EXPECT_EQ(merged.positions, positions);
  EXPECT_EQ(merged.triangles, triangles);
}

/// A ring of vertices would part the surface in two.
TEST(Regularization, ARingStays)
{
  const Bipyramid whole;
  const CrossingMesh merged = mergeVertices(
    {}, { whole.positions, whole.triangles, {}, { 0, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2 }, 3 });
  const Topology sphere{ 2, 1, 0, true };
  EXPECT_EQ(topologyOf(whole.triangles), sphere);
  EXPECT_EQ(topologyOf(merged.triangles), sphere);
}

TEST(Regularization, NeighborsBecomeOneVertexAtTheirMean)
{
  Bipyramid whole;
  std::vector<Vector>& positions = whole.positions;
  const auto merge = [&]()
  {
    return mergeVertices(
      {}, { positions, whole.triangles, {}, { 0, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4 }, 5 });
  };
  const CrossingMesh merged = merge();
  ASSERT_EQ(merged.positions.size(), 5u);
  EXPECT_EQ(merged.triangles.size(), 6u);
  EXPECT_EQ(merged.memberBegins, (std::vector<std::size_t>{ 0, 1, 2, 5, 8, 11 }));
  EXPECT_EQ(merged.members[2], 3u); // the nearest
  const Vector mean = 1.0 / 3.0 * (positions[2] + positions[3] + positions[4]);
  EXPECT_LT(lengthOf(merged.positions[2] - mean), 1e-12);
  // The mean of equal coordinates is not off by rounding.
  std::for_each(positions.begin(), positions.end(), [](Vector& p) { p[2] = 0.7; });
  for (const Vector& position : merge().positions)
  {
    EXPECT_EQ(position[2], 0.7);
  }
}

// The edge across a crease stays, and so does one of a flat tetrahedron, whose other diagonal is an
// edge already.
TEST(EdgeFlipping, TheLongDiagonalOfAQuadrilateralIsFlipped)
{
  const Triangles two{ { 0, 1, 2 }, { 0, 2, 3 } };
  EXPECT_EQ(flipped({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, two),
    (Triangles{ { 0, 1, 3 }, { 1, 2, 3 } }));
  EXPECT_EQ(flipped({ { -3, 0, 0 }, { 0, -1, -2 }, { 3, 0, 0 }, { 0, 1, -2 } }, two), two);
  const Triangles four{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } };
  EXPECT_EQ(flipped({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0.1 } }, four), four);
}
