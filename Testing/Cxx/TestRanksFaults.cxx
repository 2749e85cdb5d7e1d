// SPDX-License-Identifier: GPL-3.0-or-later
// What fails on one rank ends the work of all; none of them waits forever, and the next call
// works.
#include "FailingAllocator.h"
#include "RandomRequests.h"
#include "RankTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <vector>

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

/// What came of work on several ranks while an allocation failed.
struct Outcome
{
  std::atomic<int> failures{ 0 };
  std::atomic<int> others{ 0 };
  std::atomic<bool> wasReached{ false };

  void expectAllOrNone(int ranks) const
  {
    EXPECT_TRUE(this->failures + this->others == 0 || this->failures + this->others == ranks);
    EXPECT_LE(this->failures, 1);
  }
};

/// Does work on all ranks while the n-th allocation of at least some bytes of one of them fails.
template <class Work>
void failingAt(long n, std::size_t bytes, int failingRank, isopoint::Communicator& communicator,
  isopoint::Team& team, Outcome& outcome, const Work& work)
{
  wait(communicator);
  if (communicator.rank() == failingRank)
  {
    failingallocator::failAt(n, false, bytes);
  }
  wait(communicator);
  try
  {
    team.together(work);
  }
  catch (const std::bad_alloc&)
  {
    ++outcome.failures;
  }
  catch (const isopoint::FailedElsewhere&)
  {
    ++outcome.others;
  }
  wait(communicator);
  if (communicator.rank() == failingRank)
  {
    outcome.wasReached = failingallocator::stop() >= n;
  }
  wait(communicator);
}

/// Loads, extracts with ghosts and replaces the values on several ranks while the n-th allocation
/// of at least some bytes fails, then again.
/// @returns whether there were that many
bool failsAt(long n, std::size_t bytes, const std::vector<clouds::Cloud>& pieces,
  const isopoint::ExtractionRequest& request, const ranks::Description& expected)
{
  Outcome outcome;
  ranks::Description found;
  std::mutex mutex;
  ThreadRanks threads(static_cast<int>(pieces.size()));
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::Team team(communicator);
      const clouds::Cloud& piece = pieces[static_cast<std::size_t>(team.rank())];
      const auto read = clouds::readerOf(piece);
      const isopoint::Execution execution = clouds::executionOn(1);
      isopoint::IsosurfaceExtractor extractor;
      bool isLoaded = false;
      failingAt(n, bytes, 0, communicator, team, outcome,
        [&]()
        {
          extractor.load<double, double>(execution, team, piece.size(), read);
          isLoaded = true;
          isopoint::ExtractedIsosurface ghosts;
          extractor.extract(execution, request, &ghosts);
          isLoaded = false;
          extractor.replaceValues<double, double>(execution, piece.size(), read);
          isLoaded = true;
        });
      team.together(
        [&]()
        {
          if (team.isAny(!isLoaded))
          {
            extractor.load<double, double>(execution, team, piece.size(), read);
          }
          const auto extracted = extractor.extract(execution, request);
          const ranks::Description own = ranks::described(extracted);
          const std::lock_guard<std::mutex> lock(mutex);
          found.insert(found.end(), own.begin(), own.end());
        });
    });
  std::sort(found.begin(), found.end());
  outcome.expectAllOrNone(static_cast<int>(pieces.size()));
  EXPECT_TRUE(found == expected);
  return outcome.wasReached;
}

/// Lets each allocation of at least some bytes fail in turn.
/// @param step after the first 200
void expectFailuresEndTheWorkOfAll(
  const isopoint::ExtractionRequest& request, std::size_t samples, std::size_t bytes, long step)
{
  const std::vector<clouds::Cloud> pieces = ranks::dealOut(
    clouds::coincident(clouds::uniform(samples, 1), 0.05), 3, ranks::Deal::RoundRobin);
  ranks::Description expected = ranks::extractOnRanks(pieces, { request }).front();
  std::sort(expected.begin(), expected.end());
  ASSERT_FALSE(expected.empty());
  long n = 1;
  while (failsAt(n, bytes, pieces, request, expected) && !testing::Test::HasFailure())
  {
    SCOPED_TRACE(n);
    n += n < 200 ? 1 : step;
  }
  EXPECT_GT(n, 100);
}

void expectAbortsEndTheWorkOfAll(const isopoint::ExtractionRequest& request)
{
  const std::vector<clouds::Cloud> pieces =
    ranks::dealOut(clouds::uniform(3000, 2), 3, ranks::Deal::Even);
  for (int last = 0; last < 40; ++last)
  {
    std::atomic<int> aborts{ 0 };
    std::atomic<int> finished{ 0 };
    ThreadRanks threads(3);
    threads.run(
      [&](isopoint::Communicator& communicator)
      {
        isopoint::Team team(communicator);
        const clouds::Cloud& piece = pieces[static_cast<std::size_t>(team.rank())];
        isopoint::Execution execution;
        int questions = 0;
        execution.aborted = [&]() { return team.rank() == 1 && questions++ >= last; };
        isopoint::IsosurfaceExtractor extractor;
        try
        {
          team.together(
            [&]()
            {
              extractor.load<double, double>(
                execution, team, piece.size(), clouds::readerOf(piece));
              extractor.extract(execution, request);
            });
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
  expectFailuresEndTheWorkOfAll(everythingOfPoints(), 1500, failingallocator::largeSize, 7);
}

TEST(RanksFaults, LackOfMemoryOnOneRankEndsTheTrianglesOfAll)
{
  expectFailuresEndTheWorkOfAll(triangles(), 1500, failingallocator::largeSize, 7);
}

TEST(RanksFaults, LackOfAFewBytesEndsTheWorkOfAll)
{
  expectFailuresEndTheWorkOfAll(everythingOfPoints(), 200, 1, 97);
}

TEST(RanksFaults, LackOfAFewBytesEndsTheTrianglesOfAll)
{
  expectFailuresEndTheWorkOfAll(triangles(), 200, 1, 97);
}

/// The environment variables RANKS_FIRST_SEED and RANKS_SEEDS choose other clouds, options, ranks
/// and faults.
TEST(RanksFaults, ByChanceEndTheWorkOfAll)
{
  const std::uint64_t first = clouds::numberFrom("RANKS_FIRST_SEED", 1);
  const std::uint64_t count = clouds::numberFrom("RANKS_SEEDS", 20);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    clouds::Dice dice(seed);
    const std::vector<clouds::Cloud> pieces =
      ranks::dealOut(clouds::randomCloud(dice, seed), 2 + dice(4), ranks::allDeals[dice(6)]);
    isopoint::ExtractionRequest request = clouds::randomRequest(dice);
    request.triangles = dice(2) == 0;
    request.ghostRings = static_cast<int>(dice(3));
    ranks::Description expected = ranks::extractOnRanks(pieces, { request }).front();
    std::sort(expected.begin(), expected.end());
    for (int fault = 0; fault < 10 && !HasFailure(); ++fault)
    {
      const auto most = static_cast<std::size_t>(std::pow(10.0, 1.0 + 3.5 * dice.real()));
      const std::size_t bytes = dice(2) == 0 ? 1 : failingallocator::largeSize;
      failsAt(1 + static_cast<long>(dice(most)), bytes, pieces, request, expected);
    }
  }
}

TEST(RanksFaults, AnAbortOnOneRankEndsTheWorkOfAll)
{
  expectAbortsEndTheWorkOfAll(everythingOfPoints());
}

TEST(RanksFaults, AnAbortOnOneRankEndsTheTrianglesOfAll)
{
  expectAbortsEndTheWorkOfAll(triangles());
}

/// A rank that throws anywhere makes the next collective function of all others throw, whichever
/// that is, and the team works again afterwards.
TEST(RanksFaults, EachCollectiveFunctionLearnsOfAFailure)
{
  using Step = std::function<void(isopoint::Team&)>;
  const std::vector<Step> steps{
    [](isopoint::Team& team) { team.isAny(true); },
    [](isopoint::Team& team) { team.maximum(~std::uint64_t{ 0 }); },
    [](isopoint::Team& team) { team.sum(~std::uint64_t{ 0 }); },
    [](isopoint::Team& team) { team.gather(std::uint64_t{ 1 }); },
    [](isopoint::Team& team) { team.gather(std::vector<int>(5, 1)); },
    [](isopoint::Team& team) {
      team.exchange(std::vector<std::vector<int>>(3, { 1, 2 }));
    },
    [](isopoint::Team& /*team*/) {} // none: what follows is the end of the work
  };
  ThreadRanks threads(3);
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::Team team(communicator);
      for (const Step& step : steps)
      {
        const auto work = [&]()
        {
          team.sum(1);
          if (team.rank() == 2)
          {
            throw std::bad_alloc();
          }
          step(team);
        };
        if (team.rank() == 2)
        {
          EXPECT_THROW(team.together(work), std::bad_alloc);
        }
        else
        {
          EXPECT_THROW(team.together(work), isopoint::FailedElsewhere);
        }
        team.together([&]() { EXPECT_EQ(team.sum(2), 6u); });
      }
    });
}
