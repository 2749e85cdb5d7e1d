// SPDX-License-Identifier: GPL-3.0-or-later
// A failure on one rank ends the work of all. No rank waits forever, and the next call works.
#include "FailingAllocator.h"
#include "RankTesting.h"

#include <new>

namespace
{

using ranks::Request;
using Contents = std::pair<ranks::Description, ranks::Description>;

const Request points = clouds::withSplats(clouds::requestOf(0.3, isopoint::FitOrder::Cubic, true));

const Request triangles = []()
{
  Request request = clouds::withTriangles(points);
  request.triangleGhostRings = 1;
  return request;
}();

Contents expectedOf(const std::vector<clouds::Cloud>& pieces, const Request& request)
{
  return ranks::contentsOf(ranks::extractOnRanks(pieces, { request }).front());
}

/// What ends the work: an allocation on the first rank that fails, or an abort on the second one.
struct Fault
{
  long allocation = 0; // that fails: its number, from 1, among allocations of at least `bytes`
  std::size_t bytes = failingallocator::largeSize;
  int abort = -1; // how many questions for it are answered with no
};

/// Loads, extracts with ghosts and replaces the values on several ranks with a fault, then expects
/// the right result of the next extraction.
/// @returns whether there was such an allocation
bool expectRecovery(const Fault& fault, const std::vector<clouds::Cloud>& pieces,
  const Request& request, const Contents& expected)
{
  const int size = static_cast<int>(pieces.size());
  std::atomic<int> failures{ 0 };
  std::atomic<int> others{ 0 };
  std::atomic<int> aborts{ 0 };
  std::atomic<bool> wasReached{ false };
  std::vector<ranks::Extracted> found(pieces.size());
  ThreadRanks threads(size);
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      // Does work on the first rank while the others wait.
      const auto onFirst = [&communicator](const auto& work)
      {
        std::uint64_t number = 0;
        communicator.allReduce(&number, 1, isopoint::Reduction::Sum);
        if (communicator.rank() == 0)
        {
          work();
        }
        communicator.allReduce(&number, 1, isopoint::Reduction::Sum);
      };
      isopoint::ProcessGroup processes(communicator);
      const clouds::Cloud& piece = pieces[static_cast<std::size_t>(processes.rank())];
      const auto read = clouds::readerOf(piece);
      isopoint::Execution execution;
      int questions = 0;
      if (fault.abort >= 0 && processes.rank() == 1)
      {
        execution.isAborted = [&]() { return questions++ >= fault.abort; };
      }
      isopoint::IsosurfaceExtractor extractor;
      bool isLoaded = false;
      onFirst([&]() { failingallocator::failAt(fault.allocation, false, fault.bytes); });
      try
      {
        processes.runCollectively(
          [&]()
          {
            extractor.load<double, double>(execution, processes, piece.size(), read);
            isLoaded = true;
            ranks::Extracted ghosts;
            extractor.extract(execution, request, &ghosts);
            isLoaded = false;
            extractor.replaceValues<double, double>(execution, piece.size(), read);
            isLoaded = true;
          });
      }
      catch (const std::bad_alloc&)
      {
        ++failures;
      }
      catch (const isopoint::FailedElsewhere&)
      {
        ++others;
      }
      catch (const isopoint::Aborted&)
      {
        ++aborts;
      }
      onFirst([&]() { wasReached = failingallocator::stop() >= fault.allocation; });
      processes.runCollectively(
        [&]()
        {
          if (processes.isAny(!isLoaded))
          {
            extractor.load<double, double>({}, processes, piece.size(), read);
          }
          found[static_cast<std::size_t>(processes.rank())] = extractor.extract({}, request);
        });
    });
  EXPECT_TRUE(failures + others == 0 || failures + others == size);
  EXPECT_LE(failures, 1);
  EXPECT_TRUE(aborts == 0 || aborts == size) << aborts;
  EXPECT_TRUE(ranks::contentsOf(found) == expected);
  return wasReached;
}

} // namespace

TEST(RanksFaults, LackOfMemoryOnOneRankEndsTheWorkOfAll)
{
  // Numbers of samples, least bytes of the allocations that fail, steps after the first 200.
  for (const auto& [samples, bytes, step] :
    { std::tuple(1500, failingallocator::largeSize, 7L), std::tuple(200, std::size_t{ 1 }, 97L) })
  {
    const std::vector<clouds::Cloud> pieces = ranks::dealOut(
      clouds::coincident(clouds::uniform(static_cast<std::size_t>(samples), 1), 0.05), 3,
      ranks::Deal::RoundRobin);
    for (const Request& request : { points, triangles })
    {
      const Contents expected = expectedOf(pieces, request);
      ASSERT_FALSE(expected.first.empty());
      ASSERT_EQ(expected.second.empty(), !request.triangles);
      long n = 1;
      while (expectRecovery({ n, bytes }, pieces, request, expected) && !HasFailure())
      {
        n += n < 200 ? 1 : step;
      }
      EXPECT_GT(n, 100) << "too few allocations were reached";
    }
  }
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
    Request request = ranks::randomRequest(dice);
    request.triangles = dice(2) == 0;
    request.triangleGhostRings = static_cast<int>(dice(3));
    const Contents expected = expectedOf(pieces, request);
    for (int fault = 0; fault < 10 && !HasFailure(); ++fault)
    {
      const auto most = static_cast<std::size_t>(std::pow(10.0, 1.0 + 3.5 * dice.real()));
      const std::size_t bytes = dice(2) == 0 ? 1 : failingallocator::largeSize;
      const Fault failure{ 1 + static_cast<long>(dice(most)), bytes };
      expectRecovery(failure, pieces, request, expected);
    }
  }
}

TEST(RanksFaults, AnAbortOnOneRankEndsTheWorkOfAll)
{
  const std::vector<clouds::Cloud> pieces =
    ranks::dealOut(clouds::uniform(3000, 2), 3, ranks::Deal::Even);
  for (const Request& request : { points, triangles })
  {
    const Contents expected = expectedOf(pieces, request);
    for (int questions = 0; questions < 40; ++questions)
    {
      expectRecovery({ 0, 0, questions }, pieces, request, expected);
    }
  }
}

/// A rank that throws makes the next collective function of all others throw, whichever that is.
/// The group of processes works afterwards.
TEST(RanksFaults, EachCollectiveFunctionLearnsOfAFailure)
{
  using Step = std::function<void(isopoint::ProcessGroup&)>;
  const std::vector<Step> steps{ [](isopoint::ProcessGroup& processes) { processes.isAny(true); },
    [](isopoint::ProcessGroup& processes) { processes.maximum(~std::uint64_t{ 0 }); },
    [](isopoint::ProcessGroup& processes) { processes.sum(~std::uint64_t{ 0 }); },
    [](isopoint::ProcessGroup& processes) { processes.gather(std::uint64_t{ 1 }); },
    [](isopoint::ProcessGroup& processes) { processes.gather(std::vector<int>(5, 1)); },
    [](isopoint::ProcessGroup& processes) {
      processes.exchange(std::vector<std::vector<int>>(3, { 1, 2 }));
    },
    [](isopoint::ProcessGroup& /*processes*/) {} };
  ThreadRanks threads(3);
  threads.run(
    [&](isopoint::Communicator& communicator)
    {
      isopoint::ProcessGroup processes(communicator);
      for (const Step& step : steps)
      {
        const auto work = [&]()
        {
          processes.sum(1);
          if (processes.rank() == 2)
          {
            throw std::bad_alloc();
          }
          step(processes);
        };
        if (processes.rank() == 2)
        {
          EXPECT_THROW(processes.runCollectively(work), std::bad_alloc);
        }
        else
        {
          EXPECT_THROW(processes.runCollectively(work), isopoint::FailedElsewhere);
        }
        processes.runCollectively([&]() { EXPECT_EQ(processes.sum(2), 6u); });
      }
    });
}
