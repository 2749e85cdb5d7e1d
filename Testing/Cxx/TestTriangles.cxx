// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of triangles: closed, oriented, in a defined order, and close to the true surface.
#include "RandomClouds.h"
#include "TriangleTesting.h"

#include "Core/IsosurfaceExtractor.h"

#include <map>
#include <set>

namespace
{

using clouds::Cloud;
using clouds::Random;
using isopoint::ExtractedIsosurface;
using isopoint::SurfaceTriangle;
using isopoint::Vector;

using DirectedEdge = std::pair<std::size_t, std::size_t>;

isopoint::ExtractionRequest requestOf(
  double isovalue, std::optional<isopoint::FitOrder> order = std::nullopt, bool dropsGaps = false)
{
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = isovalue;
  request.isosurface.dropsGaps = dropsGaps;
  if (order)
  {
    request.isosurface.fit = isopoint::FitRequest{ *order, true };
  }
  request.splats = isopoint::SplatOptions{};
  request.triangles = true;
  return request;
}

isopoint::IsosurfaceExtractor extractorOf(const Cloud& cloud)
{
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, cloud.size(), clouds::readerOf(cloud));
  return extractor;
}

ExtractedIsosurface trianglesOf(
  const Cloud& cloud, const isopoint::ExtractionRequest& request, std::size_t threads = 1)
{
  return extractorOf(cloud).extract(clouds::executionOn(threads), request);
}

/// How often each directed edge occurs, less its opposite; those that cancel out are left out.
std::map<DirectedEdge, int> borderOf(const std::vector<SurfaceTriangle>& triangles)
{
  std::map<DirectedEdge, int> border;
  for (const SurfaceTriangle& triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t from = triangle[i];
      const std::size_t to = triangle[(i + 1) % 3];
      border[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (auto edge = border.begin(); edge != border.end();)
  {
    edge = edge->second == 0 ? border.erase(edge) : std::next(edge);
  }
  return border;
}

/// How often each edge occurs, in either direction.
std::map<DirectedEdge, int> edgesOf(const std::vector<SurfaceTriangle>& triangles)
{
  std::map<DirectedEdge, int> edges;
  for (const SurfaceTriangle& triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++edges[std::minmax(triangle[i], triangle[(i + 1) % 3])];
    }
  }
  return edges;
}

/// Expects each edge to have two triangles, in opposite directions, and each vertex to have some.
void expectClosedManifold(const ExtractedIsosurface& extracted, long eulerCharacteristic)
{
  EXPECT_FALSE(extracted.triangles.empty());
  EXPECT_TRUE(borderOf(extracted.triangles).empty());
  const std::map<DirectedEdge, int> edges = edgesOf(extracted.triangles);
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 2);
  }
  std::set<std::size_t> used;
  for (const SurfaceTriangle& triangle : extracted.triangles)
  {
    used.insert(triangle.begin(), triangle.end());
  }
  EXPECT_EQ(used.size(), extracted.surface.size());
  EXPECT_EQ(static_cast<long>(used.size()) - static_cast<long>(edges.size()) +
              static_cast<long>(extracted.triangles.size()),
    eulerCharacteristic);
}

Vector normalOf(const ExtractedIsosurface& extracted, const SurfaceTriangle& triangle)
{
  const std::vector<Vector>& p = extracted.surface.positions;
  return isopoint::cross(isopoint::difference(p[triangle[1]], p[triangle[0]]),
    isopoint::difference(p[triangle[2]], p[triangle[0]]));
}

/// The volume that the surface encloses, positive if its normals point outwards.
double volumeOf(const ExtractedIsosurface& extracted)
{
  double sum = 0.0;
  for (const SurfaceTriangle& triangle : extracted.triangles)
  {
    sum += isopoint::dot(extracted.surface.positions[triangle[0]], normalOf(extracted, triangle));
  }
  return sum / 6.0;
}

constexpr double radius = 0.35;

double distanceFromSphere(const Vector& p)
{
  return isopoint::lengthOf({ p[0] - 0.5, p[1] - 0.5, p[2] - 0.5 }) - radius;
}

double distanceFromTorus(const Vector& p)
{
  return std::hypot(std::hypot(p[0] - 0.5, p[1] - 0.5) - 0.28, p[2] - 0.5) - 0.13;
}

template <class Field>
Cloud withField(Cloud cloud, const Field& field)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    cloud.values[i] = field({ p[0], p[1], p[2] });
  }
  return cloud;
}

double largestDistance(const ExtractedIsosurface& extracted, double (*distance)(const Vector&))
{
  double largest = 0.0;
  for (const Vector& position : extracted.surface.positions)
  {
    largest = std::max(largest, std::abs(distance(position)));
  }
  return largest;
}

} // namespace

TEST(Triangles, OfASphereAreClosed)
{
  const Cloud cloud = withField(clouds::uniform(30000, 1), distanceFromSphere);
  const ExtractedIsosurface onEdges = trianglesOf(cloud, requestOf(0.0));
  expectClosedManifold(onEdges, 2);
  const ExtractedIsosurface fitted = trianglesOf(cloud, requestOf(0.0, isopoint::FitOrder::Cubic));
  expectClosedManifold(fitted, 2);
  EXPECT_TRUE(onEdges.triangles == fitted.triangles);
  // Values grow outwards: normals point inwards.
  const double volume = 4.0 / 3.0 * 3.14159265358979 * radius * radius * radius;
  EXPECT_NEAR(-volumeOf(fitted), volume, 0.003 * volume);
  EXPECT_NEAR(-volumeOf(onEdges), volume, 0.01 * volume);
}

TEST(Triangles, OfATorusAreClosed)
{
  const Cloud cloud = withField(clouds::uniform(60000, 2), distanceFromTorus);
  expectClosedManifold(trianglesOf(cloud, requestOf(0.0)), 0);
  expectClosedManifold(trianglesOf(cloud, requestOf(0.0, isopoint::FitOrder::Cubic)), 0);
}

TEST(Triangles, FollowTheFitsAndAreNotTurnedOver)
{
  const Cloud cloud = withField(clouds::uniform(100000, 3), distanceFromTorus);
  const ExtractedIsosurface onEdges = trianglesOf(cloud, requestOf(0.0));
  const ExtractedIsosurface fitted = trianglesOf(cloud, requestOf(0.0, isopoint::FitOrder::Cubic));
  ASSERT_EQ(onEdges.surface.size(), fitted.surface.size());
  isopoint::ExtractionRequest points;
  points.isosurface = requestOf(0.0, isopoint::FitOrder::Cubic).isosurface;
  const ExtractedIsosurface isopoints = extractorOf(cloud).extract({}, points);
  EXPECT_LT(largestDistance(fitted, distanceFromTorus),
    1.5 * largestDistance(isopoints, distanceFromTorus));
  const auto turnedOver = [&](const ExtractedIsosurface& extracted)
  {
    return std::count_if(extracted.triangles.begin(), extracted.triangles.end(),
      [&](const SurfaceTriangle& triangle)
      {
        const Vector& p = extracted.surface.positions[triangle[0]];
        const double ring = 1.0 - 0.28 / std::hypot(p[0] - 0.5, p[1] - 0.5);
        const Vector outward{ ring * (p[0] - 0.5), ring * (p[1] - 0.5), p[2] - 0.5 };
        return isopoint::dot(outward, normalOf(extracted, triangle)) >= 0.0;
      });
  };
  // Flat tetrahedra have a few before anything moves.
  EXPECT_LE(turnedOver(fitted), turnedOver(onEdges));
  EXPECT_LT(turnedOver(onEdges), 20);
}

/// A vertex that a fit would move across the opposite edge of its triangle stays, and so do its
/// neighbors.
TEST(Triangles, StayWhereAMoveWouldTurnThemOver)
{
  const std::vector<Vector> unmoved{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 1.0, 1.0, 0.0 } };
  const std::vector<SurfaceTriangle> triangles{ { 0, 1, 2 }, { 1, 3, 2 } };
  std::vector<isopoint::LocalFit> fits(4);
  for (std::size_t i = 0; i < 4; ++i)
  {
    fits[i].order = isopoint::FitOrder::Cubic;
    fits[i].gradient = { 0.0, 0.1, -2.0 };
    fits[i].position = isopoint::sum(unmoved[i], 0.1, { 0.1, 0.2, 1.0 });
  }
  const std::vector<isopoint::LocalFit> before = fits;
  isopoint::keepTrianglesUpright({}, unmoved, triangles, fits);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(fits[i].order.has_value());
    EXPECT_EQ(fits[i].position, before[i].position);
  }
  fits[0].position = { 1.2, 1.2, 0.0 };
  isopoint::keepTrianglesUpright({}, unmoved, triangles, fits);
  for (const std::size_t i : { 0, 1, 2 })
  {
    EXPECT_FALSE(fits[i].order.has_value());
    EXPECT_EQ(fits[i].position, unmoved[i]);
  }
  EXPECT_TRUE(fits[3].order.has_value());
  EXPECT_EQ(fits[3].position, before[3].position);
}

TEST(Triangles, HaveNormalsAgainstTheGradient)
{
  const Cloud cloud = withField(clouds::uniform(30000, 4), distanceFromSphere);
  const auto expectInward = [](const ExtractedIsosurface& extracted, double leastCosine)
  {
    ASSERT_EQ(extracted.normals.size(), extracted.surface.size());
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      const Vector& p = extracted.surface.positions[i];
      const Vector inward = isopoint::directionOf({ 0.5 - p[0], 0.5 - p[1], 0.5 - p[2] });
      EXPECT_GT(isopoint::dot(inward, extracted.normals[i]), leastCosine);
    }
  };
  expectInward(trianglesOf(cloud, requestOf(0.0, isopoint::FitOrder::Cubic)), 0.99);
  expectInward(trianglesOf(cloud, requestOf(0.0)), 0.6); // of triangles
}

/// Where the surface leaves the hull it ends in the crossing facets of the hull, and nowhere else.
TEST(Triangles, EndAtTheHullAlone)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const Cloud cloud = clouds::uniform(2000, seed);
    const ExtractedIsosurface extracted = trianglesOf(cloud, requestOf(0.3));
    const std::map<DirectedEdge, int> border = borderOf(extracted.triangles);
    EXPECT_EQ(border.size(), triangles::crossingHullFacets(cloud, 0.3));
    for (const auto& [edge, count] : edgesOf(extracted.triangles))
    {
      EXPECT_EQ(count, border.count(edge) ? 1 : 2);
    }
  }
}

/// Vertices on edges to samples with the isovalue are one vertex, at the sample.
TEST(Triangles, MeetAtSamplesWithTheIsovalue)
{
  Cloud cloud;
  for (int x = -8; x <= 8; ++x)
  {
    for (int y = -8; y <= 8; ++y)
    {
      for (int z = -8; z <= 8; ++z)
      {
        cloud.add(x, y, z, x * x + y * y + z * z);
      }
    }
  }
  for (const double isovalue : { 25.0, 26.0, 36.0, 38.0 })
  {
    SCOPED_TRACE(isovalue);
    const ExtractedIsosurface extracted = trianglesOf(cloud, requestOf(isovalue));
    expectClosedManifold(extracted, 2);
    std::set<Vector> places(extracted.surface.positions.begin(), extracted.surface.positions.end());
    EXPECT_EQ(places.size(), extracted.surface.size());
    for (const SurfaceTriangle& triangle : extracted.triangles)
    {
      EXPECT_GT(isopoint::lengthOf(normalOf(extracted, triangle)), 0.0);
    }
  }
}

TEST(Triangles, AreBalancedForAnyCloud)
{
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    Cloud cloud = clouds::randomCloud(dice, seed);
    // Values of few kinds, the isovalue among them, inside a hull of samples above it.
    double farthest = 1.0;
    for (const double coordinate : cloud.positions)
    {
      farthest = std::max(farthest, std::abs(coordinate));
    }
    for (double& value : cloud.values)
    {
      value = static_cast<double>(dice(5));
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      const auto side = [&](int bit)
      { return (corner >> bit) % 2 ? 3.0 * farthest : -3.0 * farthest; };
      cloud.add(side(0), side(1), side(2), 9.0);
    }
    const ExtractedIsosurface extracted = trianglesOf(cloud, requestOf(2.0));
    EXPECT_TRUE(borderOf(extracted.triangles).empty());
    for (const SurfaceTriangle& triangle : extracted.triangles)
    {
      EXPECT_TRUE(
        triangle[0] < triangle[1] && triangle[0] < triangle[2] && triangle[1] != triangle[2]);
    }
    EXPECT_TRUE(std::is_sorted(extracted.triangles.begin(), extracted.triangles.end()));
    EXPECT_TRUE(std::is_sorted(extracted.surface.edges.begin(), extracted.surface.edges.end(),
      [](const isopoint::IsopointEdge& a, const isopoint::IsopointEdge& b)
      { return std::pair(a.first, a.second) < std::pair(b.first, b.second); }));
  }
}

TEST(Triangles, DropWhatSpansGaps)
{
  // Two blocks of samples, far apart, with the surface between and within them.
  Cloud cloud;
  Random random(5);
  for (int i = 0; i < 6000; ++i)
  {
    const double x = random();
    const double y = random();
    const double z = random();
    cloud.add(x + (i % 2 ? 8.0 : 0.0), y, z, i % 2 ? z : z - 1.0);
  }
  const auto countBetween = [](const ExtractedIsosurface& extracted)
  {
    return std::count_if(extracted.surface.positions.begin(), extracted.surface.positions.end(),
      [](const Vector& p) { return p[0] > 1.5 && p[0] < 7.5; });
  };
  const ExtractedIsosurface whole = trianglesOf(cloud, requestOf(0.5));
  EXPECT_GT(countBetween(whole), 50);
  const ExtractedIsosurface cut = trianglesOf(cloud, requestOf(0.5, std::nullopt, true));
  // Behind samples at corners of the hull there are not two others: their edges stay.
  EXPECT_LT(countBetween(cut), countBetween(whole) / 10);
  EXPECT_GT(cut.triangles.size(), 500u);
  for (const SurfaceTriangle& triangle : cut.triangles)
  {
    for (const std::size_t vertex : triangle)
    {
      EXPECT_LT(vertex, cut.surface.size());
    }
  }
}

TEST(Triangles, OfDegenerateCloudsAreNone)
{
  EXPECT_TRUE(trianglesOf(Cloud(), requestOf(0.0)).triangles.empty());
  for (const int dimensions : { 0, 1, 2 })
  {
    const ExtractedIsosurface extracted =
      trianglesOf(clouds::flattened(clouds::uniform(300, 10), dimensions),
        requestOf(0.5, isopoint::FitOrder::Cubic));
    EXPECT_TRUE(extracted.triangles.empty());
    EXPECT_EQ(extracted.surface.size(), 0u);
  }
}
