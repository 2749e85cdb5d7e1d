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
using clouds::withValuesOf;
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

double largestDistance(const ExtractedIsosurface& extracted, double (*distance)(const Vector&))
{
  double largest = 0.0;
  for (const Vector& position : extracted.surface.positions)
  {
    largest = std::max(largest, std::abs(distance(position)));
  }
  return largest;
}

/// A grid around a post, with cells that are stretched up to 30 times.
Cloud gridAroundAPost()
{
  constexpr int layers = 16;
  constexpr int spokes = 48;
  constexpr int rings = 40;
  const double growth = std::pow(30.0, 1.0 / (rings - 2));
  Cloud cloud;
  for (int layer = 0; layer < layers; ++layer)
  {
    double radiusOfRing = 1.0;
    double width = 0.02;
    for (int ring = 0; ring < rings; ++ring)
    {
      for (int spoke = 0; spoke < spokes; ++spoke)
      {
        const double angle = 2.0 * 3.14159265358979 / spokes * spoke;
        cloud.add(radiusOfRing * std::cos(angle), radiusOfRing * std::sin(angle),
          4.0 / (layers - 1) * layer, 0.0);
      }
      radiusOfRing += width;
      width *= growth;
    }
  }
  return cloud;
}

/// A flat sheet of unit squares, each cut into two triangles, with values that fall upwards.
struct FlatSheet
{
  static constexpr int size = 7; // vertices along each side

  static std::size_t vertexAt(int x, int y) { return static_cast<std::size_t>(size * y + x); }

  FlatSheet()
    : fits(size * size)
  {
    for (int y = 0; y < size; ++y)
    {
      for (int x = 0; x < size; ++x)
      {
        this->positions.push_back({ double(x), double(y), 0.0 });
        isopoint::LocalFit& fit = this->fits[vertexAt(x, y)];
        fit.position = this->positions.back();
        fit.gradient = { 0.0, 0.0, -1.0 };
        fit.isGradientFitted = true;
        fit.order = isopoint::FitOrder::Cubic;
        if (x > 0 && y > 0)
        {
          this->triangles.push_back({ vertexAt(x - 1, y - 1), vertexAt(x, y - 1), vertexAt(x, y) });
          this->triangles.push_back({ vertexAt(x - 1, y - 1), vertexAt(x, y), vertexAt(x - 1, y) });
        }
      }
    }
  }

  std::vector<Vector> normals() const { return this->normals(true); }
  Vector trianglesNormalAt(std::size_t vertex) const { return this->normals(false)[vertex]; }

  std::vector<Vector> positions;
  std::vector<SurfaceTriangle> triangles;
  std::vector<isopoint::LocalFit> fits;

private:
  std::vector<Vector> normals(bool areOfField) const
  {
    const std::vector<Vector> decreasing(this->positions.size(), Vector{ 0.0, 0.0, 1.0 });
    return isopoint::vertexNormals(
      {}, { this->positions, decreasing, this->fits }, this->triangles, areOfField);
  }
};

} // namespace

TEST(Triangles, OfASphereAreClosed)
{
  const Cloud cloud = withValuesOf(clouds::uniform(30000, 1), distanceFromSphere);
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
  const Cloud cloud = withValuesOf(clouds::uniform(60000, 2), distanceFromTorus);
  expectClosedManifold(trianglesOf(cloud, requestOf(0.0)), 0);
  expectClosedManifold(trianglesOf(cloud, requestOf(0.0, isopoint::FitOrder::Cubic)), 0);
}

TEST(Triangles, FollowTheFitsAndAreNotTurnedOver)
{
  const Cloud cloud = withValuesOf(clouds::uniform(100000, 3), distanceFromTorus);
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

/// A vertex that a fit would move far from its triangles stays, and its neighbors move.
TEST(Triangles, StayNearTheirTriangles)
{
  FlatSheet sheet;
  for (isopoint::LocalFit& fit : sheet.fits)
  {
    fit.position[2] = 0.5;
  }
  const std::size_t far = FlatSheet::vertexAt(3, 3);
  const std::size_t crease = FlatSheet::vertexAt(1, 5);
  sheet.fits[far].position[2] = 2.9;
  sheet.fits[FlatSheet::vertexAt(5, 1)].position[2] = 2.8; // shorter than two diagonals
  sheet.fits[crease].position[2] = 2.9;
  sheet.fits[crease].order = isopoint::FitOrder::Crease;
  const std::vector<isopoint::LocalFit> before = sheet.fits;
  isopoint::keepTrianglesUpright({}, sheet.positions, sheet.triangles, sheet.fits);
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_EQ(sheet.fits[i].order.has_value(), i != far) << i;
    EXPECT_EQ(sheet.fits[i].position, i == far ? sheet.positions[i] : before[i].position) << i;
  }
}

/// Where the normal of a fit is turned away from all around, the vertex has that of its triangles.
TEST(Triangles, HaveTheirOwnNormalsWhereAFitFailed)
{
  FlatSheet sheet;
  const Vector slanted = isopoint::directionOf({ 0.1, 0.2, -1.0 });
  for (isopoint::LocalFit& fit : sheet.fits)
  {
    fit.gradient = slanted;
  }
  const std::vector<std::size_t> turned{ FlatSheet::vertexAt(0, 0), FlatSheet::vertexAt(3, 3),
    FlatSheet::vertexAt(3, 4) };
  for (const std::size_t vertex : turned)
  {
    sheet.fits[vertex].gradient = { 2.0, 0.0, -1.0 }; // by 63 degrees
  }
  const std::size_t crease = FlatSheet::vertexAt(1, 5);
  sheet.fits[crease].gradient = { 2.0, 0.0, -1.0 };
  sheet.fits[crease].order = isopoint::FitOrder::Crease;
  sheet.fits[FlatSheet::vertexAt(6, 3)].gradient = { 1.5, 0.0, -1.0 }; // by 56 degrees
  const std::vector<Vector> normals = sheet.normals();
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    const bool isTurned = std::count(turned.begin(), turned.end(), i) > 0;
    EXPECT_EQ(normals[i], isTurned
                            ? Vector({ 0.0, 0.0, 1.0 })
                            : isopoint::scaled(-1.0, isopoint::directionOf(sheet.fits[i].gradient)))
      << i;
  }
}

/// Triangles that look away from the surface around, as long thin ones may, say nothing of a fit.
TEST(Triangles, HaveNormalsAgainstTheGradientWhereTheyAreFolded)
{
  FlatSheet sheet;
  for (int y = 0; y < FlatSheet::size; ++y) // a step up, on which the vertices of x = 3 are
  {
    sheet.positions[FlatSheet::vertexAt(3, y)] = { 2.05, double(y), 0.15 };
    sheet.positions[FlatSheet::vertexAt(4, y)] = { 2.1, double(y), 0.3 };
    sheet.positions[FlatSheet::vertexAt(5, y)][2] = 0.3;
    sheet.positions[FlatSheet::vertexAt(6, y)][2] = 0.3;
  }
  const std::size_t folded = FlatSheet::vertexAt(3, 3);
  EXPECT_LT(sheet.trianglesNormalAt(folded)[2], 0.5);
  EXPECT_EQ(sheet.normals()[folded], Vector({ 0.0, 0.0, 1.0 }));
}

/// At the rim of an unevenly sampled cloud fits extrapolate, and some fail.
TEST(Triangles, HaveNormalsAsTheyLookAtTheRim)
{
  const auto wave = [](const Vector& p)
  { return 1.5 + std::sin(3.0 * p[0]) * std::cos(2.3 * p[1]); };
  const auto plane = [&](const Vector& p)
  { return wave(p) * (0.3 * p[0] + 0.2 * p[1] + p[2] - 2.03); };
  const auto curved = [&](const Vector& p)
  { return wave(p) * (p[2] - 2.03 + 0.4 * std::sin(1.1 * p[0]) * std::cos(0.7 * p[1])); };
  for (const Cloud& cloud :
    { withValuesOf(gridAroundAPost(), plane), withValuesOf(gridAroundAPost(), curved) })
  {
    isopoint::ExtractionRequest request = requestOf(0.0, isopoint::FitOrder::Cubic, true);
    const std::vector<Vector> ofFits = trianglesOf(cloud, request).normals;
    request.splats->fieldNormals = false;
    const std::vector<Vector> ofTriangles = trianglesOf(cloud, request).normals;
    ASSERT_EQ(ofFits.size(), ofTriangles.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < ofFits.size(); ++i)
    {
      EXPECT_GT(isopoint::dot(ofFits[i], ofTriangles[i]), 0.25); // of 76 degrees
      same += ofFits[i] == ofTriangles[i] ? 1 : 0;
    }
    EXPECT_LT(same, ofFits.size() / 100);
  }
}

TEST(Triangles, HaveNormalsAgainstTheGradient)
{
  const Cloud cloud = withValuesOf(clouds::uniform(30000, 4), distanceFromSphere);
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
