// SPDX-License-Identifier: GPL-3.0-or-later
// The progress that the core reports rises steadily up to 1.
#include "Clouds.h"
#include "RankTesting.h"

#include "Core/Base/Execution.h"
#include "Core/IsosurfaceExtractor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace
{

using isopoint::Execution;
using isopoint::ExtractionRequest;

/// An execution on one thread, so that batches are many, which notes its progress.
Execution notedIn(std::vector<double>& seen)
{
  Execution execution;
  execution.progress = [&seen](double share) { seen.push_back(share); };
  return execution;
}

void expectRise(const std::vector<double>& seen)
{
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GE(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
}

/// The same in steps that are not large.
void expectSteadyRise(const std::vector<double>& seen, std::size_t fewestEvents, double largestStep)
{
  expectRise(seen);
  EXPECT_GE(seen.size(), fewestEvents);
  double last = 0.0;
  for (const double share : seen)
  {
    EXPECT_LE(share - last, largestStep) << "after " << last;
    last = share;
  }
}

/// Points alone, with fits, and with splats; triangles alone, and with all that moves and drops.
std::vector<ExtractionRequest> requestsOfEveryStage()
{
  const isopoint::FitRequest fit{ isopoint::FitOrder::Quadratic, true };
  std::vector<ExtractionRequest> requests(5);
  requests[1].isosurface.fit = fit;
  requests[2].isosurface.fit = fit;
  requests[2].splats = isopoint::SplatOptions{};
  requests[3].triangles = true;
  requests[4].triangles = true;
  requests[4].isosurface.dropsGaps = true;
  requests[4].isosurface.fit = fit;
  return requests;
}

} // namespace

TEST(Progress, LoadingReportsEachBatch)
{
  std::vector<double> seen;
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<float, float>(notedIn(seen), std::size_t{ 1 } << 21,
    [](std::size_t id, auto* position, auto& value)
    {
      position[0] = position[1] = position[2] = value = static_cast<float>(id);
      return true;
    });
  expectSteadyRise(seen, 8, 0.13);
}

TEST(Progress, ExtractionsReportEachStage)
{
  const clouds::Cloud cloud = clouds::uniform(clouds::lessIfSlow(200000), 1);
  for (const ExtractionRequest& request : requestsOfEveryStage())
  {
    isopoint::IsosurfaceExtractor extractor;
    extractor.load<double, double>({}, cloud.size(), clouds::readerOf(cloud));
    for (const double isovalue : { 0.3, 0.5 }) // the second from a tree that is kept
    {
      SCOPED_TRACE(isovalue);
      ExtractionRequest other = request;
      other.isosurface.isovalue = isovalue;
      std::vector<double> seen;
      extractor.extract(notedIn(seen), other);
      expectSteadyRise(seen, 15, 0.25);
    }
  }
}

TEST(Progress, IsReportedWhereThereIsNothing)
{
  const clouds::Cloud cloud = clouds::uniform(1000, 1);
  for (const std::size_t count : { std::size_t{ 0 }, cloud.size() })
  {
    std::vector<double> seen;
    isopoint::IsosurfaceExtractor extractor;
    extractor.load<double, double>(notedIn(seen), count, clouds::readerOf(cloud));
    expectRise(seen);
    for (ExtractionRequest request : requestsOfEveryStage())
    {
      request.isosurface.isovalue = 1e9;
      seen.clear();
      extractor.extract(notedIn(seen), request);
      expectRise(seen);
    }
  }
}

TEST(Progress, RisesOnEachRank)
{
  const clouds::Cloud cloud = clouds::uniform(20000, 2);
  const std::vector<clouds::Cloud> parts = ranks::dealOut(cloud, 3, ranks::Deal::RoundRobin);
  std::vector<std::vector<double>> loading(parts.size());
  std::vector<std::vector<std::vector<double>>> extracting(parts.size());
  ranks::onRanks(parts.size(),
    [&](isopoint::Team& team)
    {
      const auto rank = static_cast<std::size_t>(team.rank());
      isopoint::IsosurfaceExtractor extractor;
      extractor.load<double, double>(
        notedIn(loading[rank]), team, parts[rank].size(), clouds::readerOf(parts[rank]));
      for (ExtractionRequest request : requestsOfEveryStage())
      {
        request.isosurface.isovalue = 0.3;
        extracting[rank].emplace_back();
        extractor.extract(notedIn(extracting[rank].back()), request);
      }
    });
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    expectRise(loading[rank]);
    EXPECT_GE(loading[rank].size(), 4u);
    for (const std::vector<double>& seen : extracting[rank])
    {
      expectRise(seen);
      EXPECT_GE(seen.size(), 8u);
    }
  }
}

TEST(Progress, StaysWhereItWouldGoBack)
{
  std::vector<double> seen;
  const Execution rising = isopoint::withRisingProgress(notedIn(seen));
  for (const double share : { 0.2, 0.8, 0.1, 0.8, 0.9 })
  {
    isopoint::partOf(rising, 0.0, 1.0).progress(share);
  }
  EXPECT_EQ(seen, (std::vector<double>{ 0.2, 0.8, 0.8, 0.8, 0.9 }));
}
