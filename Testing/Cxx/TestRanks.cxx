// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks together yield what one rank yields, however a cloud is dealt out.
#include "PlaceTesting.h"
#include "RankTesting.h"

namespace
{

using clouds::Cloud;
using clouds::requestOf;
using clouds::withSplats;
using isopoint::FitOrder;
using ranks::Deal;
using ranks::Extracted;
using ranks::Request;

Request triangles(double isovalue, std::optional<FitOrder> order = std::nullopt,
  bool dropsGaps = false, bool regularizes = false)
{
  return clouds::withTriangles(withSplats(requestOf(isovalue, order, dropsGaps)), regularizes);
}

Request keepingHullSlivers(Request request)
{
  request.isosurface.keepsHullSlivers = true;
  return request;
}

Request partingCreases(Request request)
{
  request.isosurface.duplicatesCreaseVertices = true;
  return request;
}

/// Fits for normals alone: points do not move.
Request withUnmovedFits(double isovalue)
{
  Request request = requestOf(isovalue);
  request.isosurface.fit = isopoint::FitRequest{ std::nullopt, false };
  return request;
}

Request withoutFieldNormals(Request request)
{
  request.splats->fieldNormals = false;
  return request;
}

void expectSameAsOneRank(const std::vector<Cloud>& clouds, const std::vector<std::size_t>& sizes,
  const std::vector<Deal>& deals, const std::vector<Request>& requests)
{
  for (std::size_t i = 0; i < clouds.size(); ++i)
  {
    SCOPED_TRACE(testing::Message() << "cloud " << i);
    for (const std::size_t size : sizes)
    {
      for (const Deal deal : deals)
      {
        ranks::expectSameAsOneRank(clouds[i], size, deal, requests);
      }
    }
  }
}

using Ends = std::pair<std::uint64_t, std::uint64_t>;

/// Ghosts are points of other ranks, known as well as there, each once and in order.
/// @returns how many there are
std::size_t expectGhostsOfOthers(const Cloud& cloud, std::size_t size, const Request& request)
{
  const std::vector<Cloud> pieces = ranks::dealOut(cloud, size, Deal::RoundRobin);
  const Extracted whole = clouds::extracted(ranks::concatenated(pieces), request);
  const auto knownOf = [](const Extracted& extracted)
  {
    std::map<Ends, std::string> known;
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      const isopoint::IsopointEdge& edge = extracted.surface.edges[i];
      known[{ edge.first, edge.second }] = ranks::described(extracted, i);
    }
    return known;
  };
  const std::map<Ends, std::string> all = knownOf(whole);
  std::atomic<std::size_t> count{ 0 };
  ranks::onRanks(size,
    [&](isopoint::ProcessGroup& processes, std::size_t rank)
    {
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<double, double>(
        {}, processes, pieces[rank].size(), clouds::readerOf(pieces[rank]));
      Extracted ghosts;
      std::map<Ends, std::string> known = knownOf(extractor.extract({}, request, &ghosts));
      const std::size_t ownCount = known.size();
      known.merge(knownOf(ghosts));
      EXPECT_EQ(known.size(), ownCount + ghosts.surface.size());
      EXPECT_TRUE(std::includes(all.begin(), all.end(), known.begin(), known.end()));
      EXPECT_TRUE(std::is_sorted(ghosts.surface.edges.begin(), ghosts.surface.edges.end()));
      count += ghosts.surface.size();
    });
  return count;
}

} // namespace

TEST(Ranks, YieldThePointsOfOneRank)
{
  expectSameAsOneRank(ranks::variousClouds(), { 2, 3, 4, 7 }, ranks::allDeals, { requestOf(0.3) });
  expectSameAsOneRank(ranks::variousClouds(), { 2, 5 }, { Deal::Skewed },
    { requestOf(0.1, std::nullopt, false, 0.0), requestOf(0.9, std::nullopt, true),
      requestOf(-0.4, std::nullopt, true, 120.0) });
}

TEST(Ranks, YieldTheFitsAndSplatsOfOneRank)
{
  const Request cubic = requestOf(0.3, FitOrder::Cubic);
  const Request crease = requestOf(-0.2, FitOrder::Crease, true);
  const Request unmoved = withUnmovedFits(0.5);
  expectSameAsOneRank(ranks::variousClouds(), { 2, 7 }, { Deal::RoundRobin },
    { cubic, crease, unmoved, withSplats(cubic), withSplats(crease),
      withoutFieldNormals(withSplats(unmoved)), withSplats(requestOf(0.3)) });
}

TEST(Ranks, YieldTheTrianglesOfOneRank)
{
  expectSameAsOneRank(ranks::variousClouds(), { 2, 3, 5 }, { Deal::RoundRobin },
    { triangles(0.3), triangles(-0.4, std::nullopt, true), triangles(0.5, FitOrder::Cubic),
      keepingHullSlivers(triangles(-0.4, std::nullopt, true)),
      triangles(0.5, FitOrder::Cubic, true, true), triangles(99.0) });
  expectSameAsOneRank({ clouds::uniform(4000, 12) }, { 3 }, ranks::allDeals,
    { triangles(0.3), triangles(-0.2, FitOrder::Cubic, true),
      triangles(-0.2, FitOrder::Cubic, true, true) });
}

TEST(Ranks, YieldTheCreasesOfOneRank)
{
  const Cloud cube = clouds::withValuesOf(clouds::uniform(6000, 14),
    [](const isopoint::Vector& p) {
      return std::max({ std::abs(p[0] - 0.5), std::abs(p[1] - 0.5), std::abs(p[2] - 0.5) });
    });
  const std::vector<Request> requests{ triangles(0.3, FitOrder::Crease),
    partingCreases(triangles(0.3, FitOrder::Crease)), triangles(0.3, FitOrder::Cubic),
    partingCreases(triangles(0.3, FitOrder::Crease, false, true)) };
  std::vector<std::size_t> counts;
  for (const Request& request : requests)
  {
    counts.push_back(clouds::extracted(cube, request).triangles.size());
  }
  EXPECT_EQ(counts[0], counts[1]);
  EXPECT_GT(counts[0], counts[2] + counts[2] / 20) << "edges have vertices of their own";
  expectSameAsOneRank({ cube }, { 3 }, ranks::allDeals, requests);
}

TEST(Ranks, MayBeMoreThanSamples)
{
  for (std::size_t count = 0; count < 8; ++count)
  {
    expectSameAsOneRank({ clouds::uniform(count, 12) }, { 7 }, { Deal::RoundRobin },
      { requestOf(0.3), triangles(0.3, FitOrder::Cubic) });
  }
}

TEST(Ranks, SendManySamplesInSlices)
{
  ranks::expectSameAsOneRank<float, float>(
    clouds::uniform(1 << 20, 41), 2, Deal::RoundRobin, { requestOf(0.3) });
}

/// The environment variables RANKS_FIRST_SEED and RANKS_SEEDS choose other clouds, options and
/// ranks than the first hundred and fifty.
TEST(Ranks, YieldTheRandomResultsOfOneRank)
{
  const std::uint64_t first = clouds::numberFrom("RANKS_FIRST_SEED", 1);
  const std::uint64_t count = clouds::numberFrom("RANKS_SEEDS", 150);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    clouds::Dice dice(seed);
    const Cloud cloud = clouds::randomCloud(dice, seed);
    const Deal deal = ranks::allDeals[dice(6)];
    const std::size_t size = 2 + dice(dice(4) == 0 ? 12 : 5);
    std::vector<Request> requests(1 + dice(3));
    std::generate(requests.begin(), requests.end(), [&]() { return ranks::randomRequest(dice); });
    if (seed - first < clouds::lessIfSlow(count))
    {
      const double isovalue = cloud.size() > 0 ? cloud.values[dice(cloud.size())] : 0.0;
      Request crease = triangles(isovalue, FitOrder::Crease);
      crease.isosurface.duplicatesCreaseVertices = seed % 2 == 0;
      requests.insert(requests.end(), { triangles(isovalue, FitOrder::Cubic), crease,
                                        triangles(isovalue, std::nullopt, dice(2) == 0),
                                        triangles(isovalue, FitOrder::Cubic, false, true),
                                        keepingHullSlivers(triangles(isovalue, std::nullopt, true)),
                                        triangles(isovalue, std::nullopt, dice(2) == 0, true) });
    }
    const std::size_t threads = 1 + dice(2);
    const auto values = dice(3) == 0 ? ranks::Values::Replaced : ranks::Values::Loaded;
    const auto expectSame = dice(2) == 0 ? ranks::expectSameAsOneRank<float, float>
                                         : ranks::expectSameAsOneRank<double, double>;
    expectSame(cloud, size, deal, requests, threads, values);
  }
}

TEST(Ranks, KnowGhostsAsWellAsTheRanksThatHaveThem)
{
  const Request cubic = requestOf(0.3, FitOrder::Cubic);
  for (const Request& request :
    { requestOf(0.3), cubic, withSplats(cubic), withSplats(requestOf(-0.2, FitOrder::Crease, true)),
      withoutFieldNormals(withSplats(cubic)) })
  {
    std::size_t count = 0;
    for (const Cloud& cloud : ranks::variousClouds())
    {
      count += expectGhostsOfOthers(cloud, 4, request);
    }
    EXPECT_GT(count, 1000u);
  }
  EXPECT_EQ(expectGhostsOfOthers(Cloud(), 3, withSplats(cubic)), 0u);
}

TEST(Ranks, SendFewerBytesOfNewValuesThanOfSamples)
{
  const std::vector<Cloud> pieces = ranks::dealOut(clouds::uniform(20000, 31), 3, Deal::RoundRobin);
  ranks::onRanks(3,
    [&](isopoint::ProcessGroup& processes, std::size_t rank)
    {
      const Cloud& piece = pieces[rank];
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<float, float>({}, processes, piece.size(), clouds::readerOf(piece));
      const std::uint64_t loading = ThreadRanks::traffic.sent;
      const auto replace = [&](const Cloud& cloud)
      { return extractor.replaceValues<float, float>({}, cloud.size(), clouds::readerOf(cloud)); };
      EXPECT_TRUE(replace(ranks::withOtherValues(piece)));
      EXPECT_LT(ThreadRanks::traffic.sent - loading, loading / 2);
      // One sample that moves, leaves or changes its type on one rank is enough.
      Cloud moved = piece;
      Cloud fewer = piece;
      if (rank == 1)
      {
        moved.positions[7] += 1e-3;
        fewer.values[100] = std::nan("");
      }
      EXPECT_FALSE(replace(moved));
      EXPECT_FALSE(replace(fewer));
      Cloud mirrored = piece;
      std::swap(mirrored.positions[0], mirrored.positions[3]);
      EXPECT_FALSE(replace(mirrored));
      EXPECT_FALSE(
        (extractor.replaceValues<double, float>({}, piece.size(), clouds::readerOf(piece))));
      EXPECT_TRUE(replace(piece));
    });
}

/// A ring of ghosts is all triangles of other ranks with a vertex in the part within.
TEST(Ranks, HaveGhostTrianglesInRings)
{
  const std::vector<Cloud> pieces = ranks::dealOut(clouds::uniform(6000, 15), 4, Deal::RoundRobin);
  const Extracted all = clouds::extracted(ranks::concatenated(pieces), triangles(0.3));
  const ranks::Description everywhere = ranks::describedTriangles(all);
  std::vector<Request> requests(4, triangles(0.3));
  for (int rings = 0; rings < 4; ++rings)
  {
    requests[static_cast<std::size_t>(rings)].triangleGhostRings = rings;
  }
  const auto found = ranks::extractOnRanks(pieces, requests);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    EXPECT_GT(found[0][rank].surface.size(), found[0][rank].countHere()) << "a seam";
    const ranks::Description own = ranks::describedTriangles(found[0][rank]);
    std::set<std::string> inside(own.begin(), own.end()); // triangles
    for (std::size_t rings = 1; rings < requests.size(); ++rings)
    {
      std::set<std::size_t> reached; // vertices
      for (std::size_t i = 0; i < everywhere.size(); ++i)
      {
        if (inside.count(everywhere[i]) > 0)
        {
          reached.insert(all.triangles[i].begin(), all.triangles[i].end());
        }
      }
      for (std::size_t i = 0; i < everywhere.size(); ++i)
      {
        const auto& [a, b, c] = all.triangles[i];
        if (reached.count(a) + reached.count(b) + reached.count(c) > 0)
        {
          inside.insert(everywhere[i]);
        }
      }
      const Extracted& withGhosts = found[rings][rank];
      const ranks::Description described = ranks::describedTriangles(withGhosts);
      EXPECT_GT(withGhosts.ghostTriangles, 0u);
      ASSERT_EQ(described.size(), own.size() + withGhosts.ghostTriangles);
      EXPECT_TRUE(std::equal(own.begin(), own.end(), described.begin()));
      EXPECT_TRUE(std::set<std::string>(described.begin(), described.end()) == inside);
    }
  }
}

TEST(Ranks, PlacesHaveTheValuesOfOneRank)
{
  for (const Cloud& cloud : { clouds::uniform(3000, 1), clouds::clustered(2000, 2),
         clouds::coincident(clouds::uniform(1200, 4), 0.4), clouds::lattice(12, 12, 12),
         clouds::flattened(clouds::uniform(900, 9), 2), clouds::uniform(5, 3), Cloud() })
  {
    const std::vector<places::Vector> all = places::randomPlaces(cloud, 200, -0.5, 1.5, 7);
    for (const std::size_t size : { 2, 3, 5 })
    {
      for (const Deal deal : { Deal::Even, Deal::RoundRobin, Deal::Last, Deal::Spatial })
      {
        const std::vector<Cloud> pieces = ranks::dealOut(cloud, size, deal);
        const Cloud whole = ranks::concatenated(pieces);
        for (const places::PlaceMethod method : places::allMethods)
        {
          SCOPED_TRACE(testing::Message() << size << " ranks, method " << int(method));
          const places::ProbeOptions options{ method, places::OutsideStrategy::Nearest, 0.0 };
          const places::Probed expected =
            places::probe(whole, all, options, places::variousArrays(whole));
          std::vector<places::Probed> found(size);
          ranks::onRanks(size,
            [&](isopoint::ProcessGroup& processes, std::size_t rank)
            {
              isopoint::IsosurfaceExtractor extractor;
              extractor.load<double, double>(
                {}, processes, pieces[rank].size(), clouds::readerOf(pieces[rank]));
              // Each rank asks for some of the places; the last one for none, if there are others.
              std::vector<places::Vector> own;
              for (std::size_t i = rank; i < all.size() && rank + 1 < size; i += size - 1)
              {
                own.push_back(all[i]);
              }
              found[rank] = places::probe(extractor, own, options,
                places::slice(
                  places::variousArrays(whole), ranks::firstOf(pieces, rank), pieces[rank].size()));
            });
          for (std::size_t i = 0; i < all.size(); ++i)
          {
            ASSERT_EQ(found[i % (size - 1)].at(i / (size - 1)).bytes(), expected.at(i).bytes());
          }
        }
      }
    }
  }
}
