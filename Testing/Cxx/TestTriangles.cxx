// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of triangles: closed, oriented, in a defined order, and close to the true surface.
#include "RandomClouds.h"
#include "Topology.h"
#include "TriangleTesting.h"

#include "Core/Triangles/VertexNormals.h"

namespace
{

using namespace isopoint;
using clouds::Cloud;
using clouds::withValuesOf;
using topology::distanceFromSphere;
using topology::normalOf;

ExtractionRequest requestOf(
  double isovalue, std::optional<FitOrder> order = std::nullopt, bool dropsGaps = false)
{
  return clouds::withTriangles(clouds::withSplats(clouds::requestOf(isovalue, order, dropsGaps)));
}

/// How often each directed edge occurs, less its opposite; those that cancel out are left out.
std::map<topology::Edge, int> borderOf(const std::vector<SurfaceTriangle>& triangles)
{
  std::map<topology::Edge, int> border;
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

/// Expects each edge to have two triangles, in opposite directions, and each vertex to have some.
void expectClosedManifold(const ExtractedIsosurface& extracted, long eulerCharacteristic)
{
  EXPECT_TRUE(borderOf(extracted.triangles).empty());
  EXPECT_EQ(topology::topologyOf(extracted.triangles),
    (topology::Topology{ eulerCharacteristic, 1, 0, true }));
  std::set<std::size_t> used;
  for (const SurfaceTriangle& triangle : extracted.triangles)
  {
    used.insert(triangle.begin(), triangle.end());
  }
  EXPECT_EQ(used.size(), extracted.surface.size());
}

/// The volume that the surface encloses, positive if its normals point outwards.
double volumeOf(const ExtractedIsosurface& extracted)
{
  const std::vector<Vector>& p = extracted.surface.positions;
  return clouds::sumOf(extracted.triangles, [&](const SurfaceTriangle& triangle)
    { return dot(p[triangle[0]], normalOf(p, triangle)) / 6.0; });
}

double distanceFromTorus(const Vector& p)
{
  return std::hypot(std::hypot(p[0] - 0.5, p[1] - 0.5) - 0.28, p[2] - 0.5) - 0.13;
}

double largestDistance(const ExtractedIsosurface& extracted, double (*distance)(const Vector&))
{
  return clouds::largestOf(
    extracted.surface.positions, [&](const Vector& p) { return std::abs(distance(p)); });
}

/// A grid around a post, with cells that are stretched up to 30 times.
Cloud gridAroundAPost()
{
  constexpr int layers = 16;
  constexpr int spokes = 48;
  constexpr int rings = 40;
  const double growth = std::pow(30.0, 1.0 / (rings - 2));
  Cloud cloud;
  double radius = 1.0;
  double width = 0.02;
  for (int ring = 0; ring < rings; ++ring)
  {
    for (int i = 0; i < layers * spokes; ++i)
    {
      const double angle = 2.0 * 3.14159265358979 / spokes * (i % spokes);
      cloud.add(
        radius * std::cos(angle), radius * std::sin(angle), 4.0 / (layers - 1) * (i / spokes), 0.0);
    }
    radius += width;
    width *= growth;
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
        LocalFit& fit = this->fits[vertexAt(x, y)];
        fit.position = this->positions.back();
        fit.gradient = { 0.0, 0.0, -1.0 };
        fit.isGradientFitted = true;
        fit.order = FitOrder::Cubic;
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
  std::vector<LocalFit> fits;

private:
  std::vector<Vector> normals(bool areOfField) const
  {
    const std::vector<Vector> decreasing(this->positions.size(), Vector{ 0.0, 0.0, 1.0 });
    return vertexNormals(
      {}, { this->positions, decreasing, this->fits }, this->triangles, areOfField, false);
  }
};

} // namespace

TEST(Triangles, OfASphereAreClosedWithNormalsAgainstTheGradient)
{
  const Cloud cloud = withValuesOf(clouds::uniform(30000, 1), distanceFromSphere);
  const ExtractedIsosurface onEdges = clouds::extracted(cloud, requestOf(0.0));
  expectClosedManifold(onEdges, 2);
  const ExtractedIsosurface fitted = clouds::extracted(cloud, requestOf(0.0, FitOrder::Cubic));
  expectClosedManifold(fitted, 2);
  EXPECT_TRUE(onEdges.triangles == fitted.triangles);
  // Values grow outwards: normals point inwards.
  const double volume = 4.0 / 3.0 * 3.14159265358979 * 0.35 * 0.35 * 0.35;
  EXPECT_NEAR(-volumeOf(fitted), volume, 0.003 * volume);
  EXPECT_NEAR(-volumeOf(onEdges), volume, 0.01 * volume);
  const auto expectInward = [](const ExtractedIsosurface& extracted, double minCosine)
  {
    ASSERT_EQ(extracted.normals.size(), extracted.surface.size());
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      const Vector inward = Vector{ 0.5, 0.5, 0.5 } - extracted.surface.positions[i];
      EXPECT_GT(dot(directionOf(inward), extracted.normals[i]), minCosine);
    }
  };
  expectInward(fitted, 0.99);
  expectInward(onEdges, 0.6); // of triangles
}

TEST(Triangles, OfATorusAreClosedFollowTheFitsAndAreNotTurnedOver)
{
  const Cloud cloud = withValuesOf(clouds::uniform(100000, 3), distanceFromTorus);
  const ExtractedIsosurface onEdges = clouds::extracted(cloud, requestOf(0.0));
  const ExtractedIsosurface fitted = clouds::extracted(cloud, requestOf(0.0, FitOrder::Cubic));
  ASSERT_EQ(onEdges.surface.size(), fitted.surface.size());
  expectClosedManifold(onEdges, 0);
  expectClosedManifold(fitted, 0);
  const ExtractedIsosurface isopoints =
    clouds::extracted(cloud, clouds::requestOf(0.0, FitOrder::Cubic));
  EXPECT_LT(largestDistance(fitted, distanceFromTorus),
    1.5 * largestDistance(isopoints, distanceFromTorus));
  const auto turnedOver = [&](const ExtractedIsosurface& extracted)
  {
    const std::vector<Vector>& positions = extracted.surface.positions;
    return clouds::countOf(extracted.triangles,
      [&](const SurfaceTriangle& triangle)
      {
        const auto [x, y, z] = positions[triangle[0]] - Vector{ 0.5, 0.5, 0.5 };
        const double ring = 1.0 - 0.28 / std::hypot(x, y);
        return dot({ ring * x, ring * y, z }, normalOf(positions, triangle)) >= 0.0;
      });
  };
  // Flat tetrahedra have a few before anything moves.
  EXPECT_LE(turnedOver(fitted), turnedOver(onEdges));
  EXPECT_LT(turnedOver(onEdges), 20u);
}

/// A vertex that a fit would move across the opposite edge of its triangle stays, and so do its
/// neighbors.
TEST(Triangles, StayWhereAMoveWouldTurnThemOver)
{
  const std::vector<Vector> unmoved{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 1.0, 1.0, 0.0 } };
  const std::vector<SurfaceTriangle> triangles{ { 0, 1, 2 }, { 1, 3, 2 } };
  std::vector<LocalFit> fits(4);
  for (std::size_t i = 0; i < 4; ++i)
  {
    fits[i].order = FitOrder::Cubic;
    fits[i].gradient = { 0.0, 0.1, -2.0 };
    fits[i].position = unmoved[i] + 0.1 * Vector{ 0.1, 0.2, 1.0 };
  }
  const std::vector<LocalFit> before = fits;
  keepTrianglesUpright({}, unmoved, triangles, fits);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(fits[i].order.has_value());
    EXPECT_EQ(fits[i].position, before[i].position);
  }
  fits[0].position = { 1.2, 1.2, 0.0 };
  keepTrianglesUpright({}, unmoved, triangles, fits);
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
  for (LocalFit& fit : sheet.fits)
  {
    fit.position[2] = 0.5;
  }
  const std::size_t far = FlatSheet::vertexAt(3, 3);
  const std::size_t crease = FlatSheet::vertexAt(1, 5);
  sheet.fits[far].position[2] = 2.9;
  sheet.fits[FlatSheet::vertexAt(5, 1)].position[2] = 2.8; // shorter than two diagonals
  sheet.fits[crease].position[2] = 2.9;
  sheet.fits[crease].order = FitOrder::Crease;
  const std::vector<LocalFit> before = sheet.fits;
  keepTrianglesUpright({}, sheet.positions, sheet.triangles, sheet.fits);
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
  const Vector slanted = directionOf({ 0.1, 0.2, -1.0 });
  for (LocalFit& fit : sheet.fits)
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
  sheet.fits[crease].order = FitOrder::Crease;
  sheet.fits[FlatSheet::vertexAt(6, 3)].gradient = { 1.5, 0.0, -1.0 }; // by 56 degrees
  const std::vector<Vector> normals = sheet.normals();
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    const bool isTurned = std::count(turned.begin(), turned.end(), i) > 0;
    EXPECT_EQ(
      normals[i], isTurned ? Vector({ 0.0, 0.0, 1.0 }) : -directionOf(sheet.fits[i].gradient))
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

/// Faces of thin bodies share the vertices of their rim, whose normals may not be turned from
/// either.
TEST(Triangles, OfThinBodiesHaveNormalsThatNoneContradicts)
{
  const std::vector<Vector> positions{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 0.3, 0.3, 0.1 }, { 0.05, 0.05, -0.01 } };
  const std::vector<SurfaceTriangle> triangles{ { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 1, 0, 4 },
    { 2, 1, 4 }, { 0, 2, 4 } };
  LocalFit upwards;
  upwards.gradient = { 0.0, 0.0, -1.0 };
  upwards.isGradientFitted = true;
  upwards.order = FitOrder::Cubic;
  std::vector<LocalFit> fits(positions.size(), upwards);
  fits[4].gradient = { 0.0, 0.0, 1.0 };
  const std::vector<Vector> decreasing(positions.size(), Vector{ 0.0, 0.0, 1.0 });
  const auto contradictions = [&](bool areOfField, bool isClosed)
  {
    const std::vector<Vector> normals =
      vertexNormals({}, { positions, decreasing, fits }, triangles, areOfField, isClosed);
    int count = 0;
    for (const SurfaceTriangle& triangle : triangles)
    {
      count += static_cast<int>(std::count_if(triangle.begin(), triangle.end(),
        [&](std::size_t corner)
        { return dot(normals[corner], normalOf(positions, triangle)) < 0.0; }));
    }
    return count;
  };
  EXPECT_GT(contradictions(true, false), 0);
  EXPECT_GT(contradictions(false, false), 0);
  EXPECT_EQ(contradictions(true, true), 0);
  EXPECT_EQ(contradictions(false, true), 0);
}

/// No vertex gets a normal that is turned farther from a triangle than before, and many a better
/// one.
TEST(Triangles, OfThinBodiesGetNoWorseNormals)
{
  const Cloud cloud = withValuesOf(clouds::uniform(20000, 31), distanceFromSphere);
  const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(0.0));
  std::vector<Vector> positions = extracted.surface.positions;
  for (Vector& position : positions)
  {
    position[2] *= 0.003;
  }
  const std::vector<LocalFit> fits(positions.size());
  const auto leastCosines = [&](bool isClosed)
  {
    const std::vector<Vector> normals = vertexNormals({},
      { positions, extracted.surface.decreasingEdges, fits }, extracted.triangles, false, isClosed);
    std::vector<double> least(positions.size(), 1.0);
    for (const SurfaceTriangle& triangle : extracted.triangles)
    {
      for (const std::size_t corner : triangle)
      {
        least[corner] =
          std::min(least[corner], dot(normals[corner], directionOf(normalOf(positions, triangle))));
      }
    }
    return least;
  };
  const std::vector<double> before = leastCosines(false);
  const std::vector<double> after = leastCosines(true);
  int betterCount = 0;
  for (std::size_t i = 0; i < after.size(); ++i)
  {
    EXPECT_GE(after[i], before[i] - 1e-12) << i;
    betterCount += after[i] > before[i] + 1e-3 ? 1 : 0;
  }
  EXPECT_GT(betterCount, 20);
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
    ExtractionRequest request = requestOf(0.0, FitOrder::Cubic, true);
    const std::vector<Vector> ofFits = clouds::extracted(cloud, request).normals;
    request.splats->fieldNormals = false;
    const std::vector<Vector> ofTriangles = clouds::extracted(cloud, request).normals;
    ASSERT_EQ(ofFits.size(), ofTriangles.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < ofFits.size(); ++i)
    {
      EXPECT_GT(dot(ofFits[i], ofTriangles[i]), 0.25); // of 76 degrees
      same += ofFits[i] == ofTriangles[i] ? 1 : 0;
    }
    EXPECT_LT(same, ofFits.size() / 100);
  }
}

/// Where the surface leaves the hull it ends in the crossing facets of the hull, and nowhere else.
TEST(Triangles, EndAtTheHullAlone)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const Cloud cloud = clouds::uniform(2000, seed);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(0.3));
    const triangles::FullTetrahedralization full(cloud);
    std::size_t facets = 0;
    for (const auto cell : full.cells.all_cell_handles())
    {
      facets += full.cells.is_infinite(cell) && full.isCrossing(cell, 0.3) ? 1 : 0;
    }
    const std::map<topology::Edge, int> border = borderOf(extracted.triangles);
    EXPECT_EQ(border.size(), facets);
    for (const auto& [edge, count] : topology::edgesOf(extracted.triangles))
    {
      EXPECT_EQ(count, border.count(edge) ? 1 : 2);
    }
  }
}

/// Vertices on edges to samples with the isovalue are one vertex, at the sample.
TEST(Triangles, MeetAtSamplesWithTheIsovalue)
{
  const Cloud cloud = withValuesOf(clouds::lattice(17, 17, 17), [](const Vector& p)
    { return std::pow(p[0] - 8.0, 2) + std::pow(p[1] - 8.0, 2) + std::pow(p[2] - 8.0, 2); });
  for (const double isovalue : { 25.0, 26.0, 36.0, 38.0 })
  {
    SCOPED_TRACE(isovalue);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(isovalue));
    expectClosedManifold(extracted, 2);
    const std::vector<Vector>& positions = extracted.surface.positions;
    EXPECT_EQ(std::set<Vector>(positions.begin(), positions.end()).size(), positions.size());
    for (const SurfaceTriangle& triangle : extracted.triangles)
    {
      EXPECT_GT(lengthOf(normalOf(positions, triangle)), 0.0);
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
    const double side = 3.0 * std::max(1.0, clouds::largestOf(cloud.positions, [](double coordinate)
                                              { return std::abs(coordinate); }));
    std::generate(
      cloud.values.begin(), cloud.values.end(), [&]() { return static_cast<double>(dice(5)); });
    for (int corner = 0; corner < 8; ++corner)
    {
      cloud.add(
        corner % 2 ? side : -side, corner / 2 % 2 ? side : -side, corner / 4 ? side : -side, 9.0);
    }
    const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(2.0));
    EXPECT_TRUE(borderOf(extracted.triangles).empty());
    for (const auto& [a, b, c] : extracted.triangles)
    {
      EXPECT_TRUE(a < b && a < c && b != c);
    }
    EXPECT_TRUE(std::is_sorted(extracted.triangles.begin(), extracted.triangles.end()));
    EXPECT_TRUE(std::is_sorted(extracted.surface.edges.begin(), extracted.surface.edges.end()));
  }
}

// Two blocks of samples, far apart, with the surface between and within them.
TEST(Triangles, DropWhatSpansGaps)
{
  Cloud cloud;
  clouds::Random random(5);
  for (int i = 0; i < 6000; ++i)
  {
    const auto [x, y, z] = random.place();
    cloud.add(x + (i % 2 ? 8.0 : 0.0), y, z, i % 2 ? z : z - 1.0);
  }
  const auto countBetween = [](const ExtractedIsosurface& extracted)
  {
    return clouds::countOf(
      extracted.surface.positions, [](const Vector& p) { return p[0] > 1.5 && p[0] < 7.5; });
  };
  const ExtractedIsosurface whole = clouds::extracted(cloud, requestOf(0.5));
  EXPECT_GT(countBetween(whole), 50u);
  const ExtractedIsosurface cut = clouds::extracted(cloud, requestOf(0.5, std::nullopt, true));
  // Behind samples at corners of the hull there are not two others: their edges stay.
  EXPECT_LT(countBetween(cut), countBetween(whole) / 10);
  EXPECT_GT(cut.triangles.size(), 500u);
  for (const auto& [a, b, c] : cut.triangles)
  {
    EXPECT_LT(std::max({ a, b, c }), cut.surface.size());
  }
}

TEST(Triangles, OfDegenerateCloudsAreNone)
{
  EXPECT_TRUE(clouds::extracted(Cloud(), requestOf(0.0)).triangles.empty());
  for (const int dimensions : { 0, 1, 2 })
  {
    const ExtractedIsosurface extracted = clouds::extracted(
      clouds::flattened(clouds::uniform(300, 10), dimensions), requestOf(0.5, FitOrder::Cubic));
    EXPECT_TRUE(extracted.triangles.empty());
    EXPECT_EQ(extracted.surface.size(), 0u);
  }
}
