// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever ranks a cloud is dealt out to, they yield together what one process does.
#include "RankTesting.h"

#include "Core/Base/Offset.h"
#include "Core/Base/Vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

using clouds::Cloud;
using ranks::variousClouds;

TEST(Ranks, YieldThePointsOfOneProcess)
{
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 3, 4, 7 })
    {
      for (const ranks::Deal deal : ranks::allDeals)
      {
        SCOPED_TRACE(
          std::to_string(size) + " ranks, deal " + std::to_string(static_cast<int>(deal)));
        isopoint::ExtractionRequest request;
        request.isosurface.isovalue = 0.3;
        ranks::expectSameAsOneProcess(cloud, size, deal, { request });
      }
    }
  }
}

TEST(Ranks, MoreThanSamples)
{
  for (std::size_t count = 0; count < 6; ++count)
  {
    isopoint::ExtractionRequest request;
    request.isosurface.isovalue = 0.3;
    ranks::expectSameAsOneProcess(
      clouds::uniform(count, 12), 7, ranks::Deal::RoundRobin, { request });
  }
}

TEST(Ranks, GapsAndAnglesAndFurtherIsovalues)
{
  for (const Cloud& cloud : variousClouds())
  {
    std::vector<isopoint::ExtractionRequest> requests(3);
    requests[0].isosurface = { 0.1, 0.0, false, std::nullopt };
    requests[1].isosurface = { 0.9, 54.7, true, std::nullopt };
    requests[2].isosurface = { -0.4, 120.0, true, std::nullopt };
    for (const int size : { 2, 5 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::Skewed, requests);
    }
  }
}

TEST(Ranks, YieldTheFitsOfOneProcess)
{
  std::vector<isopoint::ExtractionRequest> requests(3);
  requests[0].isosurface = { 0.3, 54.7, false,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  requests[1].isosurface = { -0.2, 54.7, true,
    isopoint::FitRequest{ isopoint::FitOrder::Crease, true } };
  requests[2].isosurface = { 0.5, 54.7, false, isopoint::FitRequest{ std::nullopt, false } };
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 7 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::RoundRobin, requests);
    }
  }
}

TEST(Ranks, YieldTheSplatsOfOneProcess)
{
  std::vector<isopoint::ExtractionRequest> requests(4);
  requests[0].isosurface = { 0.3, 54.7, false,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  requests[1].isosurface = { -0.2, 54.7, true,
    isopoint::FitRequest{ isopoint::FitOrder::Crease, true } };
  requests[1].minimumSpacing = 0.5;
  requests[2].isosurface = { 0.5, 54.7, false, isopoint::FitRequest{ std::nullopt, false } };
  requests[3].isosurface = { 0.3, 54.7, false, std::nullopt };
  for (isopoint::ExtractionRequest& request : requests)
  {
    request.splats = isopoint::SplatOptions();
  }
  requests[2].splats->fieldNormals = false;
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 7 })
    {
      ranks::expectSameAsOneProcess(cloud, size, ranks::Deal::RoundRobin, requests);
    }
  }
}

namespace
{

using Ends = std::pair<std::uint64_t, std::uint64_t>;

Ends endsOf(const isopoint::IsopointEdge& edge)
{
  return { edge.first, edge.second };
}

/// Ghosts are points of other ranks, known as well as there, each once and in order.
/// @returns how many there are
std::size_t expectGhostsOfOthers(
  const Cloud& cloud, int size, const isopoint::ExtractionRequest& request)
{
  const std::vector<Cloud> pieces =
    ranks::dealOut(cloud, static_cast<std::size_t>(size), ranks::Deal::RoundRobin);
  const Cloud all = ranks::concatenated(pieces);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>(isopoint::Execution(), all.size(), clouds::readerOf(all));
  const isopoint::ExtractedIsosurface whole = extractor.extract(isopoint::Execution(), request);
  std::map<Ends, std::string> known;
  for (std::size_t i = 0; i < whole.surface.size(); ++i)
  {
    known[endsOf(whole.surface.edges[i])] = ranks::described(whole, i);
  }
  std::size_t count = 0;
  for (const ranks::RankPoints& rank : ranks::extractWithGhosts(pieces, request))
  {
    std::set<Ends> own;
    for (std::size_t i = 0; i < rank.own.surface.size(); ++i)
    {
      const Ends ends = endsOf(rank.own.surface.edges[i]);
      own.insert(ends);
      EXPECT_EQ(known[ends], ranks::described(rank.own, i));
    }
    Ends former{ 0, 0 };
    for (std::size_t i = 0; i < rank.ghosts.surface.size(); ++i)
    {
      const Ends ends = endsOf(rank.ghosts.surface.edges[i]);
      EXPECT_LT(former, ends);
      EXPECT_EQ(own.count(ends), 0u);
      EXPECT_EQ(known[ends], ranks::described(rank.ghosts, i));
      former = ends;
      ++count;
    }
  }
  return count;
}

} // namespace

TEST(Ranks, GhostsAreKnownAsWellAsOnTheRanksThatHaveThem)
{
  std::vector<isopoint::ExtractionRequest> requests(5);
  requests[0].isosurface = { 0.3, 54.7, false, std::nullopt };
  requests[1].isosurface = { 0.3, 54.7, false,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  requests[2] = requests[1];
  requests[2].splats = isopoint::SplatOptions();
  requests[3].isosurface = { -0.2, 54.7, true,
    isopoint::FitRequest{ isopoint::FitOrder::Crease, true } };
  requests[3].minimumSpacing = 0.5;
  requests[3].splats = isopoint::SplatOptions();
  requests[4] = requests[2];
  requests[4].splats->fieldNormals = false;
  for (const isopoint::ExtractionRequest& request : requests)
  {
    std::size_t count = 0;
    for (const Cloud& cloud : variousClouds())
    {
      count += expectGhostsOfOthers(cloud, 4, request);
    }
    EXPECT_GT(count, 1000u);
  }
  EXPECT_EQ(expectGhostsOfOthers(clouds::uniform(0, 1), 3, requests[2]), 0u);
}

TEST(Ranks, NewValuesAtTheSamePositionsKeepTheTree)
{
  isopoint::ExtractionRequest request;
  request.isosurface = { 0.3, 54.7, false,
    isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  request.splats = isopoint::SplatOptions();
  isopoint::ExtractionRequest another = request;
  another.isosurface.isovalue = 0.7;
  for (const Cloud& cloud : variousClouds())
  {
    for (const int size : { 2, 5 })
    {
      ranks::expectSameAsOneProcess(
        cloud, size, ranks::Deal::Skewed, { request, another }, 1, ranks::Values::Replaced);
    }
  }
}

TEST(Ranks, NewValuesAreFewerBytesThanSamples)
{
  const std::vector<Cloud> pieces =
    ranks::dealOut(clouds::uniform(20000, 31), 3, ranks::Deal::RoundRobin);
  ranks::onRanks(3,
    [&](isopoint::Team& team)
    {
      const auto rank = static_cast<std::size_t>(team.rank());
      const Cloud& piece = pieces[rank];
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<float, float>(
        isopoint::Execution(), team, piece.size(), clouds::readerOf(piece));
      const std::uint64_t loading = team.traffic().sent;
      const auto replace = [&](const Cloud& cloud)
      {
        return extractor.replaceValues<float, float>(
          isopoint::Execution(), cloud.size(), clouds::readerOf(cloud));
      };
      EXPECT_TRUE(replace(ranks::withOtherValues(piece)));
      EXPECT_LT(team.traffic().sent - loading, loading / 2);
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
      EXPECT_FALSE((extractor.replaceValues<double, float>(
        isopoint::Execution(), piece.size(), clouds::readerOf(piece))));
      EXPECT_TRUE(replace(piece));
    });
}

TEST(Ranks, ManySamplesAreSentInSlices)
{
  isopoint::ExtractionRequest request;
  request.isosurface = { 0.3, 54.7, false, std::nullopt };
  ranks::expectSameAsOneProcess<float, float>(
    clouds::uniform(1 << 20, 41), 2, ranks::Deal::RoundRobin, { request });
}
