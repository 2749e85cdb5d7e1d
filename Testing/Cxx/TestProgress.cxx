// SPDX-License-Identifier: GPL-3.0-or-later
// The progress that the core reports rises steadily up to 1.
#include "RankTesting.h"

#include "Core/Base/Execution.h"

namespace
{

using namespace isopoint;

/// An execution on one thread, so that batches are many, which notes its progress.
Execution notedIn(std::vector<double>& seen)
{
  Execution execution;
  execution.progress = [&seen](double share) { seen.push_back(share); };
  return execution;
}

void expectRise(
  const std::vector<double>& seen, std::size_t fewestEvents = 1, double largestStep = 1.0)
{
  ASSERT_GE(seen.size(), fewestEvents);
  EXPECT_GE(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
  double last = 0.0;
  for (const double share : seen)
  {
    EXPECT_GE(share, last);
    EXPECT_LE(share - last, largestStep) << "after " << last;
    last = share;
  }
}

/// Points alone, with fits, and with splats; triangles alone, and with all that moves and drops.
std::vector<ExtractionRequest> requestsOfEveryStage(double isovalue)
{
  const auto fitted = clouds::requestOf(isovalue, FitOrder::Quadratic);
  return { clouds::requestOf(isovalue), fitted, clouds::withSplats(fitted),
    clouds::withTriangles(clouds::requestOf(isovalue)),
    clouds::withTriangles(clouds::requestOf(isovalue, FitOrder::Quadratic, true)) };
}

} // namespace

TEST(Progress, LoadingReportsEachBatch)
{
  std::vector<double> seen;
  IsosurfaceExtractor extractor;
  extractor.load<float, float>(notedIn(seen), std::size_t{ 1 } << 21,
    [](std::size_t id, auto* position, auto& value)
    {
      position[0] = position[1] = position[2] = value = static_cast<float>(id);
      return true;
    });
  expectRise(seen, 8, 0.13);
}

TEST(Progress, ExtractionsReportEachStage)
{
  const clouds::Cloud cloud = clouds::uniform(clouds::lessIfSlow(200000), 1);
  for (ExtractionRequest request : requestsOfEveryStage(0.3))
  {
    IsosurfaceExtractor extractor = clouds::loaded(cloud);
    for (const double isovalue : { 0.3, 0.5 }) // the second from a tree that is kept
    {
      SCOPED_TRACE(isovalue);
      request.isosurface.isovalue = isovalue;
      std::vector<double> seen;
      extractor.extract(notedIn(seen), request);
      expectRise(seen, 15, 0.25);
    }
  }
}

TEST(Progress, IsReportedWhereThereIsNothing)
{
  for (const clouds::Cloud& cloud : { clouds::Cloud(), clouds::uniform(1000, 1) })
  {
    std::vector<double> seen;
    IsosurfaceExtractor extractor;
    extractor.load<double, double>(notedIn(seen), cloud.size(), clouds::readerOf(cloud));
    expectRise(seen);
    for (const ExtractionRequest& request : requestsOfEveryStage(1e9))
    {
      seen.clear();
      extractor.extract(notedIn(seen), request);
      expectRise(seen);
    }
  }
}

TEST(Progress, RisesOnEachRank)
{
  const std::vector<clouds::Cloud> parts =
    ranks::dealOut(clouds::uniform(20000, 2), 3, ranks::Deal::RoundRobin);
  ranks::onRanks(parts.size(),
    [&](ProcessGroup& processes, std::size_t rank)
    {
      std::vector<double> seen;
      IsosurfaceExtractor extractor;
      extractor.load<double, double>(
        notedIn(seen), processes, parts[rank].size(), clouds::readerOf(parts[rank]));
      expectRise(seen, 4);
      for (const ExtractionRequest& request : requestsOfEveryStage(0.3))
      {
        seen.clear();
        extractor.extract(notedIn(seen), request);
        expectRise(seen, 8);
      }
    });
}

TEST(Progress, StaysWhereItWouldGoBack)
{
  std::vector<double> seen;
  const Execution rising = withRisingProgress(notedIn(seen));
  for (const double share : { 0.2, 0.8, 0.1, 0.8, 0.9 })
  {
    partOf(rising, 0.0, 1.0).progress(share);
  }
  EXPECT_EQ(seen, (std::vector<double>{ 0.2, 0.8, 0.8, 0.8, 0.9 }));
}
