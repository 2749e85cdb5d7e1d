// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever ranks a cloud is dealt out to, they yield together the triangles that one process does.
#include "RandomClouds.h"
#include "RankTesting.h"

#include "Core/Triangles/SurfacePart.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace
{

using clouds::Cloud;
using isopoint::ExtractedIsosurface;
using isopoint::ExtractionRequest;

ExtractionRequest requestOf(double isovalue, bool dropsGaps = false)
{
  ExtractionRequest request;
  request.isosurface.isovalue = isovalue;
  request.isosurface.dropsGaps = dropsGaps;
  request.splats = isopoint::SplatOptions();
  request.triangles = true;
  return request;
}

ExtractionRequest fitted(ExtractionRequest request)
{
  request.isosurface.fit = isopoint::FitRequest{ isopoint::FitOrder::Cubic, true };
  return request;
}

ExtractionRequest creased(ExtractionRequest request, bool partsCreases)
{
  request.isosurface.fit = isopoint::FitRequest{ isopoint::FitOrder::Crease, true };
  request.isosurface.partsCreases = partsCreases;
  return request;
}

ExtractionRequest regularized(ExtractionRequest request)
{
  request.isosurface.regularizes = true;
  return request;
}

/// Each triangle by all that is known of its vertices, in order.
ranks::Description describedTriangles(const ExtractedIsosurface& extracted)
{
  const ranks::Description vertices = ranks::described(extracted);
  ranks::Description all;
  for (const isopoint::SurfaceTriangle& triangle : extracted.triangles)
  {
    all.push_back(vertices[triangle[0]] + vertices[triangle[1]] + vertices[triangle[2]]);
  }
  return all;
}

/// Extracts, one after the other, on ranks that are threads. @returns what each rank has, by
/// request
std::vector<std::vector<ExtractedIsosurface>> trianglesOnRanks(const std::vector<Cloud>& pieces,
  const std::vector<ExtractionRequest>& requests, std::size_t threads = 1)
{
  std::vector<std::vector<ExtractedIsosurface>> all(
    requests.size(), std::vector<ExtractedIsosurface>(pieces.size()));
  ranks::onRanks(pieces.size(),
    [&](isopoint::Team& team)
    {
      const auto rank = static_cast<std::size_t>(team.rank());
      const isopoint::Execution execution = clouds::executionOn(threads);
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<double, double>(
        execution, team, pieces[rank].size(), clouds::readerOf(pieces[rank]));
      for (std::size_t i = 0; i < requests.size(); ++i)
      {
        all[i][rank] = extractor.extract(execution, requests[i]);
      }
    });
  return all;
}

/// Expects each triangle of one process on one rank, and each vertex to be counted on one.
void expectSameTriangles(const Cloud& cloud, std::size_t size, ranks::Deal deal,
  const std::vector<ExtractionRequest>& requests)
{
  const std::vector<Cloud> pieces = ranks::dealOut(cloud, size, deal);
  const Cloud whole = ranks::concatenated(pieces);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, whole.size(), clouds::readerOf(whole));
  const auto all = trianglesOnRanks(pieces, requests);
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    SCOPED_TRACE("request " + std::to_string(i));
    const ExtractedIsosurface expected = extractor.extract({}, requests[i]);
    ranks::Description expectedTriangles = describedTriangles(expected);
    ranks::Description found;
    std::size_t counted = 0;
    for (const ExtractedIsosurface& rank : all[i])
    {
      EXPECT_TRUE(std::is_sorted(rank.triangles.begin(), rank.triangles.end()));
      EXPECT_EQ(rank.ghostTriangles, 0u);
      ASSERT_EQ(rank.areElsewhere.size(), rank.surface.size());
      counted += static_cast<std::size_t>(
        std::count(rank.areElsewhere.begin(), rank.areElsewhere.end(), false));
      const ranks::Description own = describedTriangles(rank);
      found.insert(found.end(), own.begin(), own.end());
    }
    std::sort(expectedTriangles.begin(), expectedTriangles.end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), expectedTriangles.size());
    ASSERT_TRUE(found == expectedTriangles);
    EXPECT_EQ(counted, expected.surface.size());
  }
}

} // namespace

TEST(RanksTriangles, AreThoseOfOneProcess)
{
  const std::vector<ExtractionRequest> requests{ requestOf(0.3), requestOf(-0.4, true),
    fitted(requestOf(0.5)), regularized(fitted(requestOf(0.5, true))), requestOf(99.0) };
  for (const Cloud& cloud : ranks::variousClouds())
  {
    for (const std::size_t size : { 2, 3, 5 })
    {
      SCOPED_TRACE(std::to_string(size) + " ranks");
      expectSameTriangles(cloud, size, ranks::Deal::RoundRobin, requests);
    }
  }
}

TEST(RanksTriangles, DoNotDependOnHowSamplesAreDealtOut)
{
  for (const ranks::Deal deal : ranks::allDeals)
  {
    SCOPED_TRACE(static_cast<int>(deal));
    expectSameTriangles(clouds::uniform(4000, 12), 3, deal,
      { requestOf(0.3), fitted(requestOf(-0.2, true)),
        regularized(fitted(requestOf(-0.2, true))) });
  }
}

TEST(RanksTriangles, HaveTheSameCreases)
{
  Cloud cloud = clouds::uniform(6000, 14);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const auto along = [&](std::size_t axis)
    { return std::abs(cloud.positions[3 * i + axis] - 0.5); };
    cloud.values[i] = std::max({ along(0), along(1), along(2) });
  }
  const std::vector<ExtractionRequest> requests{ creased(requestOf(0.3), false),
    creased(requestOf(0.3), true), fitted(requestOf(0.3)),
    regularized(creased(requestOf(0.3), true)) };
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, cloud.size(), clouds::readerOf(cloud));
  std::vector<std::size_t> counts;
  for (const ExtractionRequest& request : requests)
  {
    counts.push_back(extractor.extract({}, request).triangles.size());
  }
  EXPECT_EQ(counts[0], counts[1]);
  EXPECT_GT(counts[0], counts[2] + counts[2] / 20) << "edges have vertices of their own";
  for (const ranks::Deal deal : ranks::allDeals)
  {
    SCOPED_TRACE(static_cast<int>(deal));
    expectSameTriangles(cloud, 3, deal, requests);
  }
}

TEST(RanksTriangles, OfFewerSamplesThanRanks)
{
  for (std::size_t count = 0; count < 8; ++count)
  {
    SCOPED_TRACE(count);
    expectSameTriangles(
      clouds::uniform(count, 13), 7, ranks::Deal::RoundRobin, { fitted(requestOf(0.3)) });
  }
}

TEST(RanksTriangles, OfAnyCloud)
{
  for (std::uint64_t seed = 1; seed <= clouds::lessIfSlow(150); ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    const Cloud cloud = clouds::randomCloud(dice, seed);
    const double isovalue = cloud.size() > 0 ? cloud.values[dice(cloud.size())] : 0.0;
    const std::size_t size = 2 + dice(4);
    expectSameTriangles(cloud, size, ranks::Deal::RoundRobin,
      { fitted(requestOf(isovalue)), creased(requestOf(isovalue), seed % 2 == 0),
        requestOf(isovalue, dice(2) == 0), regularized(fitted(requestOf(isovalue))),
        regularized(requestOf(isovalue, dice(2) == 0)) });
  }
}

/// Vertices at a seam are on two ranks or more, and counted on one.
TEST(RanksTriangles, HaveEachVertexCountedOnce)
{
  const std::vector<Cloud> pieces = ranks::dealOut(clouds::uniform(6000, 14), 4, ranks::Deal::Even);
  const Cloud whole = ranks::concatenated(pieces);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, whole.size(), clouds::readerOf(whole));
  const ExtractedIsosurface expected = extractor.extract({}, requestOf(0.3));
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> counted;
  std::size_t elsewhere = 0;
  const auto found = trianglesOnRanks(pieces, { requestOf(0.3) });
  for (const ExtractedIsosurface& rank : found.front())
  {
    for (std::size_t i = 0; i < rank.surface.size(); ++i)
    {
      const isopoint::IsopointEdge& edge = rank.surface.edges[i];
      counted[{ edge.first, edge.second }] += rank.areElsewhere[i] ? 0 : 1;
      elsewhere += rank.areElsewhere[i] ? 1 : 0;
    }
  }
  EXPECT_GT(elsewhere, 20u);
  EXPECT_EQ(counted.size(), expected.surface.size());
  for (const auto& [edge, count] : counted)
  {
    EXPECT_EQ(count, 1);
  }
}

/// A ring of ghosts is all triangles of other ranks with a vertex in the part within.
TEST(RanksTriangles, HaveGhostsInRings)
{
  const std::vector<Cloud> pieces =
    ranks::dealOut(clouds::uniform(6000, 15), 4, ranks::Deal::RoundRobin);
  const Cloud whole = ranks::concatenated(pieces);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>({}, whole.size(), clouds::readerOf(whole));
  const ExtractedIsosurface all = extractor.extract({}, requestOf(0.3));
  const ranks::Description vertices = ranks::described(all);
  const ranks::Description triangles = describedTriangles(all);
  std::vector<ExtractionRequest> requests;
  for (const int rings : { 0, 1, 2, 3 })
  {
    requests.push_back(requestOf(0.3));
    requests.back().ghostRings = rings;
  }
  const auto found = trianglesOnRanks(pieces, requests);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const ranks::Description own = describedTriangles(found[0][rank]);
    std::set<std::string> inside(own.begin(), own.end()); // triangles
    for (std::size_t rings = 1; rings < requests.size(); ++rings)
    {
      std::set<std::size_t> reached; // vertices
      for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        if (inside.count(triangles[i]) > 0)
        {
          reached.insert(all.triangles[i].begin(), all.triangles[i].end());
        }
      }
      for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        const auto& [a, b, c] = all.triangles[i];
        if (reached.count(a) + reached.count(b) + reached.count(c) > 0)
        {
          inside.insert(triangles[i]);
        }
      }
      const ExtractedIsosurface& withGhosts = found[rings][rank];
      const ranks::Description described = describedTriangles(withGhosts);
      EXPECT_GT(withGhosts.ghostTriangles, 0u);
      ASSERT_EQ(described.size(), own.size() + withGhosts.ghostTriangles);
      EXPECT_TRUE(std::equal(own.begin(), own.end(), described.begin()));
      EXPECT_TRUE(std::set<std::string>(described.begin(), described.end()) == inside);
    }
  }
}

/// The part of a rank is its triangles with their vertices, renumbered, then rings of others.
TEST(RanksTriangles, PartsAreRenumbered)
{
  // A strip: 0 1 2, 1 3 2, 2 3 4, 3 5 4.
  const std::vector<isopoint::SurfaceTriangle> strip{ { 0, 1, 2 }, { 1, 3, 2 }, { 2, 3, 4 },
    { 3, 5, 4 } };
  const std::vector<std::size_t> ranks{ 0, 0, 0, 1, 1, 1 };
  const auto partOf = [&](std::size_t rank, int rings)
  { return isopoint::SurfacePartChoice(strip, ranks, rank).choose(rings); };
  const isopoint::SurfacePart own = partOf(1, 0);
  EXPECT_EQ(own.vertices, (std::vector<std::size_t>{ 3, 4, 5 }));
  ASSERT_EQ(own.triangles.size(), 1u);
  EXPECT_EQ(own.triangles[0], (isopoint::SurfaceTriangle{ 0, 2, 1 }));
  EXPECT_EQ(own.ghostCount, 0u);
  // Vertex 3 belongs to this rank, but the first triangle that has it does not.
  EXPECT_EQ(own.areElsewhere, (std::vector<bool>{ true, true, false }));
  const isopoint::SurfacePart ring = partOf(1, 1);
  EXPECT_EQ(ring.vertices, (std::vector<std::size_t>{ 1, 2, 3, 4, 5 }));
  EXPECT_EQ(ring.ghostCount, 2u);
  ASSERT_EQ(ring.triangles.size(), 3u);
  EXPECT_EQ(ring.triangles[0], (isopoint::SurfaceTriangle{ 2, 4, 3 }));
  EXPECT_EQ(ring.triangles[1], (isopoint::SurfaceTriangle{ 0, 2, 1 }));
  EXPECT_EQ(partOf(1, 9).triangles.size(), 4u);
  EXPECT_EQ(partOf(0, 0).areElsewhere, std::vector<bool>(5, false));
}
