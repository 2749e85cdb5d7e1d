// SPDX-License-Identifier: GPL-3.0-or-later
// What fails on one rank ends the work of all; none of them waits forever, and the next call
// works.
#include "FailingAllocator.h"
#include "RankTesting.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>

namespace
{

isopoint::ExtractionRequest everythingOfPoints()
{
  isopoint::ExtractionRequest request;
  request.isosurface = { 0.3, 54.7, true, isopoint::FitRequest{ isopoint::FitOrder::Cubic, true } };
  request.minimumSpacing = 0.3;
  request.splats = isopoint::SplatOptions();
  return request;
}

isopoint::ExtractionRequest triangles()
{
  isopoint::ExtractionRequest request = everythingOfPoints();
  request.triangles = true;
  request.ghostRings = 1;
  return request;
}

void wait(isopoint::Communicator& communicator)
{
  std::uint64_t number = 0;
  communicator.allReduce(&number, 1, isopoint::Reduction::Sum);
}

/// Loads, extracts with ghosts and replaces the values on several ranks while the n-th large
/// allocation of both fails, then again.
/// @returns whether there were that many
bool failsAt(long n, const std::vector<clouds::Cloud>& pieces,
  const isopoint::ExtractionRequest& request, const ranks::Description& expected)
{
  std::atomic<int> failures{ 0 };
  std::atomic<int> others{ 0 };
  std::atomic<bool> wasReached{ false };
  ranks::Description found;
  std::mutex mutex;
  ThreadRanks team(static_cast<int>(pieces.size()));
  team.run(
    [&](isopoint::Communicator& communicator)
    {
      const clouds::Cloud& piece = pieces[static_cast<std::size_t>(communicator.rank())];
      isopoint::IsosurfaceExtractor extractor;
      const auto load = [&]()
      {
        extractor.loadOnRanks<double, double>(
          isopoint::Execution(), communicator, piece.size(), clouds::readerOf(piece));
      };
      bool isLoaded = false;
      if (communicator.rank() == 0)
      {
        failingallocator::failAt(n, false);
      }
      wait(communicator);
      try
      {
        load();
        isLoaded = true;
        isopoint::ExtractedIsosurface ghosts;
        extractor.extract(isopoint::Execution(), request, &ghosts);
        isLoaded = false;
        extractor.replaceValuesOnRanks<double, double>(
          isopoint::Execution(), piece.size(), clouds::readerOf(piece));
        isLoaded = true;
      }
      catch (const std::bad_alloc&)
      {
        ++failures;
      }
      catch (const isopoint::FailedElsewhere&)
      {
        ++others;
      }
      wait(communicator);
      if (communicator.rank() == 0)
      {
        wasReached = failingallocator::stop() >= n;
      }
      wait(communicator);
      if (!isLoaded)
      {
        load();
      }
      const auto extracted = extractor.extract(isopoint::Execution(), request);
      const ranks::Description own = ranks::described(extracted);
      const std::lock_guard<std::mutex> lock(mutex);
      found.insert(found.end(), own.begin(), own.end());
    });
  std::sort(found.begin(), found.end());
  EXPECT_TRUE(failures + others == 0 || failures + others == static_cast<int>(pieces.size()));
  EXPECT_LE(failures, 1);
  EXPECT_TRUE(found == expected);
  return wasReached;
}

} // namespace

namespace
{

/// Lets each large allocation fail in turn.
void expectFailuresEndTheWorkOfAll(const isopoint::ExtractionRequest& request)
{
  const std::vector<clouds::Cloud> pieces =
    ranks::dealOut(clouds::coincident(clouds::uniform(1500, 1), 0.05), 3, ranks::Deal::RoundRobin);
  ranks::Description expected = ranks::extractOnRanks(pieces, { request }).front();
  std::sort(expected.begin(), expected.end());
  ASSERT_FALSE(expected.empty());
  long n = 1;
  while (failsAt(n, pieces, request, expected) && !testing::Test::HasFailure())
  {
    SCOPED_TRACE(n);
    n += n < 200 ? 1 : 7;
  }
  EXPECT_GT(n, 100);
}

void expectAbortsEndTheWorkOfAll(const isopoint::ExtractionRequest& request)
{
  const std::vector<clouds::Cloud> pieces =
    ranks::dealOut(clouds::uniform(3000, 2), 3, ranks::Deal::Even);
  const std::vector<ranks::Description> expected = ranks::extractOnRanks(pieces, { request });
  for (int last = 0; last < 40; ++last)
  {
    std::atomic<int> aborts{ 0 };
    std::atomic<int> finished{ 0 };
    ThreadRanks team(3);
    team.run(
      [&](isopoint::Communicator& communicator)
      {
        const clouds::Cloud& piece = pieces[static_cast<std::size_t>(communicator.rank())];
        isopoint::Execution execution;
        int questions = 0;
        execution.aborted = [&]() { return communicator.rank() == 1 && questions++ >= last; };
        isopoint::IsosurfaceExtractor extractor;
        try
        {
          extractor.loadOnRanks<double, double>(
            execution, communicator, piece.size(), clouds::readerOf(piece));
          extractor.extract(execution, request);
          ++finished;
        }
        catch (const isopoint::Aborted&)
        {
          ++aborts;
        }
      });
    EXPECT_EQ(aborts + finished, 3);
    EXPECT_TRUE(aborts == 0 || finished == 0);
  }
}

} // namespace

TEST(RanksFaults, LackOfMemoryOnOneRankEndsTheWorkOfAll)
{
  expectFailuresEndTheWorkOfAll(everythingOfPoints());
}

TEST(RanksFaults, LackOfMemoryOnOneRankEndsTheTrianglesOfAll)
{
  expectFailuresEndTheWorkOfAll(triangles());
}

TEST(RanksFaults, AnAbortOnOneRankEndsTheWorkOfAll)
{
  expectAbortsEndTheWorkOfAll(everythingOfPoints());
}

TEST(RanksFaults, AnAbortOnOneRankEndsTheTrianglesOfAll)
{
  expectAbortsEndTheWorkOfAll(triangles());
}

namespace
{

/// Lets the n-th allocation of one rank fail, however small, while triangles are extracted.
/// @returns whether there were that many
bool extractionFailsAt(long n, const std::vector<clouds::Cloud>& pieces)
{
  std::atomic<int> failures{ 0 };
  std::atomic<int> others{ 0 };
  std::atomic<bool> wasReached{ false };
  ThreadRanks team(static_cast<int>(pieces.size()));
  team.run(
    [&](isopoint::Communicator& communicator)
    {
      const clouds::Cloud& piece = pieces[static_cast<std::size_t>(communicator.rank())];
      isopoint::IsosurfaceExtractor extractor;
      extractor.loadOnRanks<double, double>(
        isopoint::Execution(), communicator, piece.size(), clouds::readerOf(piece));
      isopoint::ExtractionRequest request;
      request.isosurface.isovalue = 0.3;
      request.isosurface.dropsGaps = true;
      request.triangles = true;
      request.ghostRings = 1;
      const isopoint::Execution execution;
      wait(communicator);
      if (communicator.rank() == 1)
      {
        failingallocator::failAt(n, false, 1);
      }
      wait(communicator);
      try
      {
        extractor.extract(execution, request);
      }
      catch (const std::bad_alloc&)
      {
        ++failures;
      }
      catch (const isopoint::FailedElsewhere&)
      {
        ++others;
      }
      wait(communicator);
      if (communicator.rank() == 1)
      {
        wasReached = failingallocator::stop() >= n;
      }
      wait(communicator);
    });
  EXPECT_TRUE(failures + others == 0 || failures + others == static_cast<int>(pieces.size()));
  return wasReached;
}

} // namespace

/// No allocation stands between two exchanges where its failure would leave other ranks waiting.
TEST(RanksFaults, LackOfAFewBytesEndsTheTrianglesOfAll)
{
  const std::vector<clouds::Cloud> pieces =
    ranks::dealOut(clouds::uniform(300, 3), 2, ranks::Deal::RoundRobin);
  long n = 1;
  while (extractionFailsAt(n, pieces) && !HasFailure())
  {
    SCOPED_TRACE(n);
    ++n;
  }
  EXPECT_GT(n, 500);
}
