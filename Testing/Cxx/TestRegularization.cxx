// SPDX-License-Identifier: GPL-3.0-or-later
// Regularized triangles: fewer and of better shape, with the topology of the exact surface.
#include "RandomClouds.h"
#include "Topology.h"

#include "Core/IsosurfaceExtractor.h"
#include "Core/OutputArrays.h"
#include "Core/Triangles/EdgeFlipping.h"
#include "Core/Triangles/VertexMerging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace
{

using clouds::Cloud;
using clouds::withValuesOf;
using isopoint::ExtractedIsosurface;
using isopoint::FitOrder;
using isopoint::SurfaceTriangle;
using isopoint::Vector;
using topology::Topology;
using topology::topologyOf;

isopoint::ExtractionRequest requestOf(
  double isovalue, bool regularizes, std::optional<FitOrder> order = std::nullopt)
{
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = isovalue;
  request.isosurface.regularizes = regularizes;
  if (order)
  {
    request.isosurface.fit = isopoint::FitRequest{ *order, true };
  }
  request.triangles = true;
  return request;
}

ExtractedIsosurface trianglesOf(
  const Cloud& cloud, const isopoint::ExtractionRequest& request, std::size_t threads = 1)
{
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, cloud.size(), clouds::readerOf(cloud));
  return extractor.extract(clouds::executionOn(threads), request);
}

Vector normalOf(const std::vector<Vector>& p, const SurfaceTriangle& triangle)
{
  return isopoint::cross(isopoint::difference(p[triangle[1]], p[triangle[0]]),
    isopoint::difference(p[triangle[2]], p[triangle[0]]));
}

double areaOf(const ExtractedIsosurface& extracted)
{
  double area = 0.0;
  for (const SurfaceTriangle& triangle : extracted.triangles)
  {
    area += 0.5 * isopoint::lengthOf(normalOf(extracted.surface.positions, triangle));
  }
  return area;
}

/// The smallest angle of each triangle in degrees, ascending.
std::vector<double> smallestAngles(const ExtractedIsosurface& extracted)
{
  std::vector<double> angles;
  const std::vector<Vector>& p = extracted.surface.positions;
  for (const SurfaceTriangle& triangle : extracted.triangles)
  {
    double smallest = 180.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector u = isopoint::difference(p[triangle[(i + 1) % 3]], p[triangle[i]]);
      const Vector v = isopoint::difference(p[triangle[(i + 2) % 3]], p[triangle[i]]);
      smallest = std::min(smallest,
        std::atan2(isopoint::lengthOf(isopoint::cross(u, v)), isopoint::dot(u, v)) * 57.29577951);
    }
    angles.push_back(smallest);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

double distanceFromSphere(const Vector& p)
{
  return isopoint::lengthOf({ p[0] - 0.5, p[1] - 0.5, p[2] - 0.5 }) - 0.35;
}

/// A number of samples as the core sees it on any order of these.
Cloud permuted(const Cloud& cloud, const std::vector<std::size_t>& order)
{
  Cloud result;
  for (const std::size_t id : order)
  {
    const double* const p = cloud.positions.data() + 3 * id;
    result.add(p[0], p[1], p[2], cloud.values[id]);
  }
  return result;
}

/// A ball's surface: two poles, and a ring of vertices around its axis.
std::vector<SurfaceTriangle> bipyramid(std::size_t count)
{
  std::vector<SurfaceTriangle> triangles;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t next = (i + 1) % count;
    triangles.push_back({ 0, 2 + i, 2 + next });
    triangles.push_back({ 1, 2 + next, 2 + i });
  }
  for (SurfaceTriangle& triangle : triangles)
  {
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<Vector> bipyramidPositions(std::size_t count)
{
  std::vector<Vector> positions{ { 0.0, 0.0, 1.0 }, { 0.0, 0.0, -1.0 } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double angle = 6.283185307 * static_cast<double>(i) / static_cast<double>(count);
    positions.push_back({ std::cos(angle), std::sin(angle), 0.0 });
  }
  return positions;
}

} // namespace

TEST(Regularization, HasAboutOneWellShapedTriangleFanForEachSample)
{
  const Cloud cloud = withValuesOf(clouds::uniform(100000, 1), distanceFromSphere);
  const ExtractedIsosurface exact = trianglesOf(cloud, requestOf(0.0, false, FitOrder::Cubic));
  const ExtractedIsosurface found = trianglesOf(cloud, requestOf(0.0, true, FitOrder::Cubic));
  EXPECT_LT(found.triangles.size(), exact.triangles.size() * 3 / 10);
  EXPECT_EQ(topologyOf(found.triangles), topologyOf(exact.triangles));
  const std::vector<double> angles = smallestAngles(found);
  EXPECT_GT(angles[angles.size() / 20], 20.0);
  EXPECT_GT(angles[angles.size() / 2], 36.0);
  EXPECT_GT(angles[angles.size() / 200], 10.0);
  double farthest = 0.0;
  for (const Vector& position : found.surface.positions)
  {
    farthest = std::max(farthest, std::abs(distanceFromSphere(position)));
  }
  EXPECT_LT(farthest, 1e-4);
}

/// Vertices beside creases are merged too, and none of them leaves its crease.
TEST(Regularization, CreasesStaySharp)
{
  const auto cube = [](const Vector& p) {
    return std::max({ std::abs(p[0] - 0.5), std::abs(p[1] - 0.5), std::abs(p[2] - 0.5) }) - 0.3;
  };
  const Cloud cloud = withValuesOf(clouds::uniform(60000, 1), cube);
  const ExtractedIsosurface exact = trianglesOf(cloud, requestOf(0.0, false, FitOrder::Crease));
  const ExtractedIsosurface found = trianglesOf(cloud, requestOf(0.0, true, FitOrder::Crease));
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
    const std::optional<FitOrder> order = orders[seed % orders.size()];
    const Topology exact =
      topologyOf(trianglesOf(cloud, requestOf(isovalue, false, order)).triangles);
    const ExtractedIsosurface found = trianglesOf(cloud, requestOf(isovalue, true, order));
    EXPECT_EQ(topologyOf(found.triangles), exact);
    manifolds += exact.isManifold && !found.triangles.empty() ? 1 : 0;
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
    const std::size_t count = 6 + dice(6);
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto coordinate = [&]() { return static_cast<double>(dice(6)); };
      const double x = coordinate();
      const double y = coordinate();
      const double z = coordinate();
      cloud.add(x, y, z, static_cast<double>(dice(3)) - 1.0);
    }
    const Topology exact = topologyOf(trianglesOf(cloud, requestOf(0.0, false)).triangles);
    EXPECT_EQ(topologyOf(trianglesOf(cloud, requestOf(0.0, true)).triangles), exact);
    branched += exact.isManifold ? 0 : 1;
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
    EXPECT_EQ(trianglesOf(cloud, requestOf(0.0, regularizes)).triangles.size(),
      trianglesOf(permuted(cloud, { 4, 3, 2, 1, 0 }), requestOf(0.0, regularizes))
        .triangles.size());
  }
}

TEST(Regularization, HugeCoordinatesHaveMeans)
{
  Cloud cloud = withValuesOf(clouds::uniform(2000, 5), distanceFromSphere);
  for (double& coordinate : cloud.positions)
  {
    coordinate = std::ldexp(coordinate, 1022);
  }
  const ExtractedIsosurface found = trianglesOf(cloud, requestOf(0.0, true));
  ASSERT_GT(found.surface.size(), 100u);
  for (const Vector& position : found.surface.positions)
  {
    EXPECT_TRUE(isopoint::isFinite(position));
  }
}

/// The mean of equal coordinates is not off by rounding.
TEST(Regularization, APlaneStaysFlat)
{
  std::vector<Vector> positions = bipyramidPositions(9);
  for (Vector& position : positions)
  {
    position[2] = 0.7;
  }
  const isopoint::MergedTriangles merged =
    isopoint::mergeVertices({}, positions, { 0, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4 }, 5, bipyramid(9));
  ASSERT_EQ(merged.positions.size(), 5u);
  for (const Vector& position : merged.positions)
  {
    EXPECT_EQ(position[2], 0.7);
  }
}

TEST(Regularization, DoesNotDependOnThreadsOrTheOrderOfSamples)
{
  const Cloud cloud = withValuesOf(clouds::uniform(20000, 2),
    [](const Vector& p) { return std::sin(9.0 * p[0]) + std::cos(8.0 * p[1]) + p[2]; });
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  clouds::Random random(3);
  for (std::size_t i = order.size() - 1; i > 0; --i)
  {
    std::swap(order[i], order[static_cast<std::size_t>(random() * static_cast<double>(i + 1))]);
  }
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
    const ExtractedIsosurface expected = trianglesOf(cloud, requestOf(0.7, true, fit));
    ASSERT_GT(expected.triangles.size(), 1000u);
    const ExtractedIsosurface onThreads = trianglesOf(cloud, requestOf(0.7, true, fit), 3);
    EXPECT_EQ(onThreads.surface.positions, expected.surface.positions);
    EXPECT_EQ(onThreads.triangles, expected.triangles);
    EXPECT_EQ(contentsOf(trianglesOf(permuted(cloud, order), requestOf(0.7, true, fit))),
      contentsOf(expected));
  }
}

/// A vertex has the mean of its crossings' attributes: exact where these are linear.
TEST(Regularization, AttributesAreMeansOverCrossings)
{
  const Cloud cloud = withValuesOf(clouds::uniform(5000, 4), distanceFromSphere);
  const ExtractedIsosurface found = trianglesOf(cloud, requestOf(0.0, true));
  ASSERT_GT(found.surface.size(), 100u);
  std::vector<Vector> places(found.surface.size());
  isopoint::interpolateComponents(
    {}, found.surface, 3,
    [&](std::uint64_t sample, int component)
    { return cloud.positions[3 * sample + static_cast<std::size_t>(component)]; },
    [&](std::size_t i, int component, double value)
    { places[i][static_cast<std::size_t>(component)] = value; });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    EXPECT_LT(
      isopoint::lengthOf(isopoint::difference(places[i], found.surface.positions[i])), 1e-12);
  }
}

/// A plane through a block ends at the block's faces, with its corners.
TEST(Regularization, BordersKeepTheirCorners)
{
  Cloud cloud;
  for (int x = 0; x <= 10; ++x)
  {
    for (int y = 0; y <= 10; ++y)
    {
      for (int z = 0; z <= 10; ++z)
      {
        cloud.add(x, y, z, z + 0.3 * x);
      }
    }
  }
  const ExtractedIsosurface exact = trianglesOf(cloud, requestOf(5.05, false));
  const ExtractedIsosurface found = trianglesOf(cloud, requestOf(5.05, true));
  EXPECT_LT(found.triangles.size(), exact.triangles.size() / 2);
  EXPECT_NEAR(areaOf(found), areaOf(exact), 1e-9);
  EXPECT_NEAR(areaOf(found), 100.0 * std::sqrt(1.09), 1e-9);
}

/// Two vertices of a tetrahedron would leave two triangles back to back.
TEST(Regularization, ATetrahedronStays)
{
  const std::vector<Vector> positions{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  const std::vector<SurfaceTriangle> triangles{ { 0, 1, 3 }, { 0, 2, 1 }, { 0, 3, 2 },
    { 1, 2, 3 } };
  const isopoint::MergedTriangles merged =
    isopoint::mergeVertices({}, positions, { 0, 0, 1, 2 }, 3, triangles);
  EXPECT_EQ(merged.positions, positions);
  EXPECT_EQ(merged.triangles, triangles);
}

/// A ring of vertices would part the surface in two.
TEST(Regularization, ARingStays)
{
  const std::vector<Vector> positions = bipyramidPositions(9);
  const std::vector<SurfaceTriangle> triangles = bipyramid(9);
  std::vector<std::size_t> nearerEnds(positions.size(), 2);
  nearerEnds[0] = 0;
  nearerEnds[1] = 1;
  const isopoint::MergedTriangles merged =
    isopoint::mergeVertices({}, positions, nearerEnds, 3, triangles);
  const Topology sphere = topologyOf(triangles);
  EXPECT_EQ(topologyOf(merged.triangles), sphere);
  EXPECT_EQ(sphere.eulerCharacteristic, 2);
}

TEST(Regularization, NeighborsBecomeOneVertexAtTheirMean)
{
  const std::vector<Vector> positions = bipyramidPositions(9);
  std::vector<std::size_t> nearerEnds{ 0, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4 };
  const isopoint::MergedTriangles merged =
    isopoint::mergeVertices({}, positions, nearerEnds, 5, bipyramid(9));
  ASSERT_EQ(merged.positions.size(), 5u);
  EXPECT_EQ(merged.triangles.size(), 6u);
  EXPECT_EQ(merged.memberBegins, (std::vector<std::size_t>{ 0, 1, 2, 5, 8, 11 }));
  EXPECT_EQ(merged.members[2], 3u); // the nearest
  const Vector mean = isopoint::scaled(
    1.0 / 3.0, isopoint::sum(isopoint::sum(positions[2], 1.0, positions[3]), 1.0, positions[4]));
  EXPECT_LT(isopoint::lengthOf(isopoint::difference(merged.positions[2], mean)), 1e-12);
}

TEST(EdgeFlipping, TheLongDiagonalOfAQuadrilateralIsFlipped)
{
  const std::vector<Vector> positions{ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } };
  std::vector<SurfaceTriangle> triangles{ { 0, 1, 2 }, { 0, 2, 3 } };
  isopoint::flipEdges({}, positions, std::vector<char>(positions.size(), 0), triangles);
  EXPECT_EQ(triangles, (std::vector<SurfaceTriangle>{ { 0, 1, 3 }, { 1, 2, 3 } }));
}

TEST(EdgeFlipping, AnEdgeAcrossACreaseStays)
{
  const std::vector<Vector> positions{ { -3, 0, 0 }, { 0, -1, -2 }, { 3, 0, 0 }, { 0, 1, -2 } };
  std::vector<SurfaceTriangle> triangles{ { 0, 1, 2 }, { 0, 2, 3 } };
  isopoint::flipEdges({}, positions, std::vector<char>(positions.size(), 0), triangles);
  EXPECT_EQ(triangles, (std::vector<SurfaceTriangle>{ { 0, 1, 2 }, { 0, 2, 3 } }));
}

/// The other diagonal is an edge already.
TEST(EdgeFlipping, AFlatTetrahedronStays)
{
  const std::vector<Vector> positions{ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0.1 } };
  const std::vector<SurfaceTriangle> expected{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } };
  std::vector<SurfaceTriangle> triangles = expected;
  isopoint::flipEdges({}, positions, std::vector<char>(positions.size(), 0), triangles);
  EXPECT_EQ(triangles, expected);
}
