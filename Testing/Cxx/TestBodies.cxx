// SPDX-License-Identifier: GPL-3.0-or-later
// Closed surfaces of bodies: against their definition by brute force, and against known bodies.
#include "BodyDefinition.h"
#include "RankTesting.h"

namespace
{

using clouds::Cloud;
using clouds::filtered;
using clouds::fromMiddle;
using clouds::Vector;
using clouds::withValuesOf;
using isopoint::ExtractedIsosurface;
using topology::Topology;
using topology::topologyOf;

constexpr double infinity = std::numeric_limits<double>::infinity();

isopoint::ExtractionRequest requestOf(double isovalue, bool dropsGaps = true)
{
  auto request = clouds::withTriangles(clouds::requestOf(isovalue, std::nullopt, dropsGaps));
  request.isosurface.caps = true;
  return request;
}

/// With the defaults of users: regularized and projected.
isopoint::ExtractionRequest defaultRequestOf(double isovalue, bool dropsGaps)
{
  auto request = requestOf(isovalue, dropsGaps);
  request.isosurface.regularizes = true;
  request.isosurface.fit = isopoint::FitRequest{ isopoint::FitOrder::Cubic, true };
  return request;
}

double one(const Vector& /*p*/)
{
  return 1.0;
}

double fromAxis(const Vector& p)
{
  return std::hypot(p[0] - 0.5, p[1] - 0.5);
}

/// Values from a few whole numbers, so that many samples have the isovalue.
Cloud withWholeValues(const Cloud& cloud, std::size_t count, std::uint64_t seed)
{
  clouds::Dice dice(seed);
  return withValuesOf(cloud, [&](const Vector& /*p*/) { return static_cast<double>(dice(count)); });
}

/// Two random boxes.
Cloud twoBoxes(std::size_t count, double gap)
{
  return clouds::moved(clouds::uniform(2 * count, 1),
    [=](double* p) { p[0] = 2.0 * p[0] + (p[0] < 0.5 ? 0.0 : gap); });
}

/// Random samples around some places: small bodies, and fragments between them.
Cloud crumbs(std::size_t count, std::uint64_t seed)
{
  clouds::Random random(seed);
  std::vector<Vector> places(8);
  std::generate(places.begin(), places.end(), [&]() { return random.place(); });
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t place = i % places.size();
    cloud.add(places[place] + random.inCube(0.06 * static_cast<double>(1 + place)), 0.0);
  }
  return cloud;
}

/// Samples of a ball or a cylinder with a bore.
template <class Distance>
Cloud bored(std::size_t count, const Distance& distance, double radius)
{
  return filtered(clouds::uniform(count, 2),
    [&](const Vector& p) { return distance(p) < 0.5 && fromAxis(p) > radius; });
}

struct Case
{
  Cloud cloud;
  double isovalue;
  bool dropsGaps;
};

std::vector<Case> allCases()
{
  const Cloud corner =
    filtered(clouds::lattice(8, 8, 8), [](const Vector& p) { return p[0] < 4.0 || p[1] < 4.0; });
  std::vector<Case> cases;
  std::uint64_t seed = 0;
  for (const Cloud& cloud : { clouds::uniform(700, 3), bored(1000, fromAxis, 0.3),
         twoBoxes(300, 0.6), clouds::scaled(clouds::uniform(500, 4), 1.0, 1.0, 0.02), corner,
         clouds::lattice(6, 7, 5), clouds::coarse(600, 8, 5),
         clouds::coincident(clouds::uniform(600, 6), 0.5), clouds::clustered(700, 7) })
  {
    cases.push_back({ withValuesOf(cloud, clouds::waves), 0.2, true });
    cases.push_back({ withWholeValues(cloud, 3, ++seed), 1.0, seed % 2 == 0 });
    cases.push_back({ withValuesOf(cloud, one), seed % 2 == 0 ? 1.0 : -infinity, true });
  }
  for (std::size_t count = 5; count <= 12; ++count)
  {
    cases.push_back({ withWholeValues(crumbs(60 * count, count), 3, count), 1.0, true });
    cases.push_back({ withWholeValues(crumbs(200, count + 4), 3, count + 4), 1.0, true });
    cases.push_back({ withWholeValues(clouds::uniform(count, count), 3, count), 1.0, true });
    cases.push_back({ withWholeValues(clouds::coarse(count, 3, count), 3, count), 1.0, true });
  }
  for (const double isovalue : { 0.0, 0.5, 1.0, 1.5, 2.0, infinity })
  {
    Cloud tetrahedron;
    for (const int i : { 0, 1, 2, 3 })
    {
      tetrahedron.add(i == 1, i == 2, i == 3, std::min(i, 2));
    }
    cases.push_back({ tetrahedron, isovalue, true });
  }
  for (const Cloud& cloud : { clouds::momentCurve(120), clouds::helix(130),
         clouds::twoSkewLines(100), clouds::tiltedWells(6, 30, 1) })
  {
    cases.push_back({ cloud, -infinity, true });
    cases.push_back({ cloud, 0.3, true });
  }
  while (cases.size() < 88)
  {
    clouds::Dice dice(++seed);
    const Cloud cloud = clouds::randomCloud(dice, seed);
    if (cloud.size() > 0 && cloud.size() < 1200)
    {
      cases.push_back({ cloud, cloud.values[dice(cloud.size())], dice(3) > 0 });
    }
  }
  return cases;
}

struct Size
{
  double volume;
  double area;
  double extent;
};

Size sizeOf(const std::vector<Vector>& positions, const topology::Triangles& triangles)
{
  long double volume = 0.0;
  Size size{};
  for (const isopoint::SurfaceTriangle& triangle : triangles)
  {
    const Vector normal = topology::normalOf(positions, triangle);
    const Vector offset = positions[triangle[0]] - positions[triangles[0][0]];
    volume += isopoint::dot(offset, normal) / 6.0;
    size.area += 0.5 * isopoint::lengthOf(normal);
    size.extent = std::max(size.extent, isopoint::lengthOf(offset));
  }
  size.volume = static_cast<double>(volume);
  return size;
}

Size sizeOf(const ExtractedIsosurface& extracted)
{
  return sizeOf(extracted.surface.positions, extracted.triangles);
}

body::Edge edgeOf(const ExtractedIsosurface& extracted, std::size_t vertex)
{
  return { extracted.surface.edges[vertex].first, extracted.surface.edges[vertex].second };
}

/// Expects two triangles at each edge, in opposite directions, one fan at each vertex, and the
/// defined order. @returns the surface by sides
body::Surface closedSurfaceOf(const ExtractedIsosurface& extracted)
{
  body::Surface surface;
  surface.areCaps = extracted.areCaps;
  std::map<topology::Edge, std::size_t> sideFrom; // by vertices
  for (const isopoint::SurfaceTriangle& triangle : extracted.triangles)
  {
    body::Triangle& corners = surface.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[k] = edgeOf(extracted, triangle[k]);
      sideFrom.emplace(topology::Edge{ triangle[k], triangle[(k + 1) % 3] }, surface.fans.size());
      surface.fans.emplace_back(corners[k], triangle[k]);
    }
  }
  surface.twins.resize(surface.fans.size());
  for (const auto& [ends, side] : sideFrom)
  {
    const auto twin = sideFrom.find({ ends.second, ends.first });
    surface.twins[side] = twin == sideFrom.end() ? side : twin->second;
  }
  const Topology topology = topologyOf(extracted.triangles);
  EXPECT_TRUE(topology.isManifold);
  EXPECT_EQ(topology.borders, 0u);
  EXPECT_EQ(sideFrom.size(), surface.fans.size()); // none occurs twice
  EXPECT_EQ(
    std::set<body::Fan>(surface.fans.begin(), surface.fans.end()).size(), extracted.surface.size());
  EXPECT_TRUE(std::is_sorted(extracted.triangles.begin(), extracted.triangles.end()));
  EXPECT_TRUE(std::is_sorted(extracted.surface.edges.begin(), extracted.surface.edges.end()));
  return surface;
}

/// A surface without the numbers of its vertices: its triangles, each with those around its sides
/// and around its corners.
auto described(const body::Surface& surface)
{
  using Described = std::pair<body::Triangle, char>;
  const auto triangleOf = [&](std::size_t side) {
    return Described{ surface.triangles[side / 3], surface.areCaps[side / 3] };
  };
  std::multiset<std::tuple<Described, std::size_t, Described>> sides;
  std::map<body::Fan, std::multiset<Described>> fans;
  for (std::size_t side = 0; side < surface.twins.size(); ++side)
  {
    sides.emplace(triangleOf(side), side % 3, triangleOf(surface.twins[side]));
    fans[surface.fans[side]].insert(triangleOf(side));
  }
  std::multiset<std::multiset<Described>> vertices;
  std::for_each(fans.begin(), fans.end(), [&](const auto& fan) { vertices.insert(fan.second); });
  return std::make_pair(sides, vertices);
}

/// All bytes of a result.
auto contentsOf(const ExtractedIsosurface& extracted)
{
  return std::make_tuple(
    ranks::described(extracted), extracted.triangles, extracted.areCaps, extracted.droppedInGaps);
}

/// The samples at vertices of caps.
std::set<std::uint64_t> samplesOf(const ExtractedIsosurface& extracted)
{
  std::set<std::uint64_t> samples;
  for (std::size_t i = 0; i < extracted.surface.size(); ++i)
  {
    const isopoint::IsopointEdge& edge = extracted.surface.edgeOf(i);
    if (edge.isSample())
    {
      samples.insert(edge.first);
    }
  }
  return samples;
}

Vector positionOf(const Cloud& cloud, std::uint64_t sample)
{
  const double* const p = cloud.positions.data() + 3 * sample;
  return { p[0], p[1], p[2] };
}

/// Expects the vertices of caps that are no samples on their edges.
/// @returns how many are not where linear interpolation places them
std::size_t expectRimOnEdges(const ExtractedIsosurface& extracted, const Cloud& cloud)
{
  std::set<std::size_t> ofCaps;
  for (std::size_t i = 0; i < extracted.triangles.size(); ++i)
  {
    if (extracted.areCaps[i])
    {
      ofCaps.insert(extracted.triangles[i].begin(), extracted.triangles[i].end());
    }
  }
  std::size_t moved = 0;
  for (const std::size_t vertex : ofCaps)
  {
    const auto [begin, end] =
      std::array{ extracted.surface.edgeBegin(vertex), extracted.surface.edgeBegin(vertex + 1) };
    EXPECT_EQ(end, begin + 1); // not merged with others
    const isopoint::IsopointEdge& edge = extracted.surface.edges[begin];
    const Vector first = positionOf(cloud, edge.first);
    const Vector along = positionOf(cloud, edge.second) - first;
    const Vector offset = extracted.surface.positions[vertex] - first;
    EXPECT_LE(isopoint::lengthOf(offset - edge.parameter * along),
      1e-12 * (isopoint::lengthOf(along) + isopoint::lengthOf(first)));
    moved += !extracted.surface.fits.empty() && extracted.surface.fits[vertex].order ? 1 : 0;
  }
  return moved;
}

} // namespace

TEST(Bodies, AreThoseOfTheDefinition)
{
  std::size_t index = 0;
  std::size_t repeated = 0; // vertices
  std::size_t dropped = 0;
  for (const auto& [cloud, isovalue, dropsGaps] : allCases())
  {
    SCOPED_TRACE(index++);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(isovalue, dropsGaps));
    body::Definition definition(cloud, isovalue, dropsGaps);
    const auto [sides, vertices] = described(closedSurfaceOf(extracted));
    const auto [expectedSides, expectedVertices] = described(definition.surface());
    ASSERT_EQ(sides.size(), expectedSides.size());
    EXPECT_TRUE(sides == expectedSides);
    EXPECT_TRUE(vertices == expectedVertices);
    const Size size = sizeOf(extracted);
    const double volume = definition.volume();
    const double rounding = 1e-15 * size.area * size.extent;
    EXPECT_NEAR(size.volume, volume, 1e-12 * volume + rounding);
    EXPECT_TRUE(definition.hasVolume() ? size.volume > 0.0 : size.volume >= -rounding);
    std::set<body::Edge> edges;
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      const body::Edge edge = edgeOf(extracted, i);
      repeated += edges.insert(edge).second ? 0 : 1;
      EXPECT_LE(isopoint::lengthOf(extracted.surface.positions[i] - definition.place(edge)),
        1e-15 * size.extent);
    }
    dropped += extracted.droppedInGaps;
  }
  EXPECT_GT(repeated, 100u);
  EXPECT_GT(dropped, 1000u);
}

/// Threads, tetrahedra of a former extraction, and ranks make no difference.
TEST(Bodies, AreTheSameHoweverTheyAreFound)
{
  std::size_t index = 0;
  for (const auto& [cloud, isovalue, dropsGaps] : allCases())
  {
    SCOPED_TRACE(index);
    const auto request = requestOf(isovalue, dropsGaps);
    const auto expected = contentsOf(clouds::extracted(cloud, request));
    EXPECT_TRUE(contentsOf(clouds::extracted(cloud, request, 3)) == expected);
    auto extractor = clouds::loaded(cloud);
    const double other = cloud.values[cloud.size() / 2];
    extractor.extract({}, clouds::withTriangles(clouds::requestOf(other)));
    EXPECT_TRUE(contentsOf(extractor.extract({}, request)) == expected);
    extractor.extract({}, requestOf(std::nextafter(other, infinity)));
    EXPECT_TRUE(contentsOf(extractor.extract({}, request)) == expected);
    ranks::expectSameAsOneRank(cloud, std::array<std::size_t, 3>{ 2, 3, 5 }[index % 3],
      ranks::allDeals[index % ranks::allDeals.size()], { request, requestOf(other) });
    ++index;
  }
}

/// Each pair of short pieces of a curve has a tetrahedron.
TEST(Bodies, OfTooManyTetrahedraAreOneErrorHoweverTheyAreFound)
{
  const auto limited = [](isopoint::ExtractionRequest request, std::size_t most)
  {
    request.isosurface.tetrahedraLimit = { most, 1 };
    return request;
  };
  constexpr std::size_t count = 300;
  const Cloud curve = clouds::momentCurve(count);
  const std::size_t most = count * count / 4; // half of them
  for (const auto& request : { requestOf(-infinity, true), requestOf(-infinity, false),
         requestOf(0.5, true), clouds::withTriangles(clouds::requestOf(0.5)),
         clouds::withTriangles(clouds::requestOf(0.9)) })
  {
    const auto expected = contentsOf(clouds::extracted(curve, request));
    EXPECT_TRUE(contentsOf(clouds::extracted(curve, limited(request, 4 * most))) == expected);
    EXPECT_TRUE(contentsOf(clouds::extracted(curve, limited(request, 3 * most))) == expected);
    for (const std::size_t threads : { 1, 3 })
    {
      const auto run = clouds::executionOn(threads);
      auto extractor = clouds::loaded(curve);
      EXPECT_THROW(extractor.extract(run, limited(request, most)), isopoint::TooManyTetrahedra);
      EXPECT_TRUE(contentsOf(extractor.extract(run, request)) == expected);
      if (request.isosurface.isovalue != -infinity)
      {
        auto first = clouds::loaded(curve);
        first.extract(run, requestOf(-infinity, true)); // whose tetrahedra are kept
        EXPECT_TRUE(contentsOf(first.extract(run, request)) == expected);
      }
    }
    for (const std::size_t size : { 2, 3, 5 })
    {
      const auto pieces = ranks::dealOut(curve, size, ranks::Deal::RoundRobin);
      ranks::onRanks(size,
        [&](isopoint::ProcessGroup& processes, std::size_t rank)
        {
          isopoint::IsosurfaceExtractor extractor;
          extractor.load<double, double>(
            {}, processes, pieces[rank].size(), clouds::readerOf(pieces[rank]));
          EXPECT_THROW(extractor.extract({}, limited(request, most)), isopoint::TooManyTetrahedra);
          EXPECT_NO_THROW(extractor.extract({}, limited(request, 4 * most)));
        });
    }
  }
}

/// Where all samples would be quicker, but are too many, those near the surface are enough.
TEST(Bodies, BesideCurvesAreNoError)
{
  Cloud cloud = clouds::uniform(3000, 31);
  clouds::Random random(32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const auto [x, y, z] = cloud.at(i);
    const double outward = std::max({ std::abs(x - 0.5), std::abs(y - 0.5), std::abs(z - 0.5) });
    cloud.values[i] = outward < 0.43 && random() < 0.5 ? 0.0 : 1.0;
  }
  const Cloud curve = clouds::momentCurve(500);
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    cloud.add(curve.at(i)[0] + 10.0, curve.at(i)[1], curve.at(i)[2], 1.0);
  }
  auto request = clouds::withTriangles(clouds::requestOf(0.5));
  const auto expected = contentsOf(clouds::extracted(cloud, request));
  request.isosurface.tetrahedraLimit = { 90000, 1 };
  EXPECT_TRUE(contentsOf(clouds::extracted(cloud, request)) == expected);
  request = requestOf(-infinity, true);
  request.isosurface.tetrahedraLimit = { 90000, 1 };
  EXPECT_THROW(clouds::extracted(cloud, request), isopoint::TooManyTetrahedra);
}

/// Only equal diagonals and first edges depend on ids.
TEST(Bodies, AreTheSameInAnyOrderOfTheSamples)
{
  for (const auto& [cloud, isovalue, dropsGaps] : allCases())
  {
    const auto request = requestOf(isovalue, dropsGaps);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, request);
    const ExtractedIsosurface other = clouds::extracted(
      clouds::permuted(cloud, clouds::randomOrder(cloud.size(), cloud.size())), request);
    EXPECT_EQ(other.triangles.size(), extracted.triangles.size());
    EXPECT_EQ(clouds::countOf(other.areCaps, [](char isCap) { return isCap != 0; }),
      clouds::countOf(extracted.areCaps, [](char isCap) { return isCap != 0; }));
    const Size size = sizeOf(extracted);
    EXPECT_NEAR(sizeOf(other).area, size.area, 1e-12 * size.area);
    EXPECT_NEAR(sizeOf(other).volume, size.volume, 1e-12 * size.area * size.extent);
  }
}

TEST(Bodies, OfConvexCloudsAreTheirHulls)
{
  const Cloud box = withValuesOf(clouds::uniform(20000, 21), one);
  const Cloud ball = withValuesOf(bored(100000, fromMiddle, -1.0), one);
  EXPECT_GT(ball.size(), 52000u);
  for (const Cloud& cloud : { box, ball })
  {
    const triangles::FullTetrahedralization full(cloud);
    std::vector<Vector> positions;
    topology::Triangles hull;
    std::vector<triangles::Delaunay::Cell_handle> outside;
    full.cells.incident_cells(full.cells.infinite_vertex(), std::back_inserter(outside));
    for (const auto cell : outside)
    {
      for (int i = 0; i < 3; ++i)
      {
        const int corner =
          triangles::Delaunay::vertex_triple_index(cell->index(full.cells.infinite_vertex()), i);
        const auto& p = cell->vertex(corner)->point();
        positions.push_back({ p.x(), p.y(), p.z() });
      }
      hull.push_back({ positions.size() - 3, positions.size() - 2, positions.size() - 1 });
    }
    const Size expected = sizeOf(positions, hull);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, requestOf(0.5), 2);
    EXPECT_EQ(extracted.triangles.size(), hull.size());
    EXPECT_NEAR(sizeOf(extracted).volume, expected.volume, 1e-9 * expected.volume);
    EXPECT_NEAR(sizeOf(extracted).area, expected.area, 1e-9 * expected.area);
    EXPECT_EQ(topologyOf(extracted.triangles), (Topology{ 2, 1, 0, true }));
  }
}

TEST(Bodies, EndAtVoids)
{
  const auto surfaceOf = [](const Cloud& cloud)
  { return clouds::extracted(withValuesOf(cloud, one), requestOf(0.5), 2); };
  const ExtractedIsosurface corner =
    surfaceOf(filtered(clouds::moved(clouds::lattice(25, 25, 25), [](double* p)
                         { std::for_each(p, p + 3, [](double& c) { c = c / 12.0 - 1.0; }); }),
      [](const Vector& p) { return p[0] <= 0.1 || p[1] <= 0.1; }));
  EXPECT_NEAR(sizeOf(corner).volume, 6.32, 0.03);
  EXPECT_EQ(topologyOf(corner.triangles), (Topology{ 2, 1, 0, true }));
  const Topology ring{ 0, 1, 0, true };
  EXPECT_EQ(topologyOf(surfaceOf(bored(40000, fromMiddle, 0.2)).triangles), ring);
  const Topology twoBalls{ 4, 2, 0, true };
  EXPECT_EQ(topologyOf(surfaceOf(twoBoxes(8000, 0.2)).triangles), twoBalls);
}

/// By default vertices are merged, edges flipped, and vertices moved.
TEST(Bodies, StayClosedWhenRegularizedAndProjected)
{
  std::size_t index = 0;
  std::size_t movedOnRim = 0;
  for (const auto& [cloud, isovalue, dropsGaps] : allCases())
  {
    SCOPED_TRACE(index);
    const ExtractedIsosurface exact = clouds::extracted(cloud, requestOf(isovalue, dropsGaps));
    const auto request = defaultRequestOf(isovalue, dropsGaps);
    const ExtractedIsosurface extracted = clouds::extracted(cloud, request);
    const Topology topology = topologyOf(extracted.triangles);
    EXPECT_TRUE(topology.isManifold);
    EXPECT_EQ(topology.borders, 0u);
    const Size size = sizeOf(extracted);
    EXPECT_GE(size.volume, -1e-15 * size.area * size.extent);
    EXPECT_EQ(extracted.areCaps.size(), extracted.triangles.size());
    EXPECT_EQ(samplesOf(extracted), samplesOf(exact));
    movedOnRim += expectRimOnEdges(extracted, cloud);
    EXPECT_TRUE(contentsOf(clouds::extracted(cloud, request, 3)) == contentsOf(extracted));
    if (index % 4 == 0)
    {
      ranks::expectSameAsOneRank(
        cloud, std::array<std::size_t, 3>{ 2, 3, 5 }[index % 3], ranks::allDeals[0], { request });
    }
    ++index;
  }
  EXPECT_GT(movedOnRim, 100u);
}

TEST(Bodies, OfLatticesHaveFlatCapsAndWellShapedTriangles)
{
  const Cloud cloud = withValuesOf(clouds::lattice(16, 16, 16),
    [](const Vector& p) {
      return clouds::waves({ p[0] / 15.0, p[1] / 15.0, p[2] / 15.0 });
    });
  const ExtractedIsosurface extracted = clouds::extracted(cloud, defaultRequestOf(0.2, true), 2);
  const ExtractedIsosurface exact = clouds::extracted(cloud, requestOf(0.2), 2);
  std::size_t caps = 0;
  for (std::size_t i = 0; i < extracted.triangles.size(); ++i)
  {
    if (extracted.areCaps[i])
    {
      ++caps;
      const auto& [a, b, c] = extracted.triangles[i];
      const std::vector<Vector>& places = extracted.surface.positions;
      const auto isOnFace = [&](std::size_t axis)
      {
        const auto isAt = [&](double face)
        { return places[a][axis] == face && places[b][axis] == face && places[c][axis] == face; };
        return isAt(0.0) || isAt(15.0);
      };
      EXPECT_TRUE(isOnFace(0) || isOnFace(1) || isOnFace(2));
    }
  }
  EXPECT_GT(caps, 100u);
  EXPECT_LT(2 * extracted.surface.size(), exact.surface.size() + samplesOf(exact).size());
  EXPECT_NEAR(sizeOf(extracted).volume, sizeOf(exact).volume, 0.01 * sizeOf(exact).volume);
}

TEST(Bodies, LeaveOutDropletsButNoBubbles)
{
  const Vector middle{ 0.35, 0.35, 0.35 };
  const Cloud cloud = withValuesOf(clouds::uniform(40000, 8),
    [&](const Vector& p)
    {
      const double distance = isopoint::lengthOf(p - middle);
      const double hollow = std::min(0.3 - distance, distance - 0.1);
      return std::max(hollow, 0.07 - isopoint::lengthOf(p - Vector{ 0.8, 0.8, 0.8 }));
    });
  auto request = defaultRequestOf(0.0, true);
  const ExtractedIsosurface all = clouds::extracted(cloud, request);
  EXPECT_EQ(topologyOf(all.triangles), (Topology{ 6, 3, 0, true }));
  request.isosurface.minimumPieceSize = 0.2; // the bubble's share is about 0.11
  const ExtractedIsosurface large = clouds::extracted(cloud, request);
  EXPECT_EQ(topologyOf(large.triangles), (Topology{ 4, 2, 0, true }));
  EXPECT_EQ(large.areCaps.size(), large.triangles.size());
  EXPECT_EQ(large.surface.size(), 4 + large.triangles.size() / 2); // none without triangles
  request.isosurface.minimumPieceSize = 0.01;
  EXPECT_TRUE(contentsOf(clouds::extracted(cloud, request)) == contentsOf(all));
}
