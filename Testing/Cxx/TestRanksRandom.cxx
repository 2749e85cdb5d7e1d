// SPDX-License-Identifier: GPL-3.0-or-later
// Random clouds, options and ranks. The environment variables RANKS_FIRST_SEED and RANKS_SEEDS
// choose others than the first hundred. The points of all ranks are those of one process.
#include "RandomRequests.h"
#include "RankTesting.h"

#include <gtest/gtest.h>

#include <string>

namespace
{

using clouds::Cloud;
using clouds::Dice;
using clouds::numberFrom;
using clouds::randomCloud;
using clouds::randomRequest;

void checkOne(std::uint64_t seed)
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  const Cloud cloud = randomCloud(dice, seed);
  const auto deal = ranks::allDeals[dice(6)];
  const int size = 2 + static_cast<int>(dice(dice(4) == 0 ? 12 : 5));
  std::vector<isopoint::ExtractionRequest> requests(1 + dice(3));
  for (isopoint::ExtractionRequest& request : requests)
  {
    request = randomRequest(dice);
  }
  const std::size_t threads = 1 + dice(2);
  const auto values = dice(3) == 0 ? ranks::Values::Replaced : ranks::Values::Loaded;
  if (dice(2) == 0)
  {
    ranks::expectSameAsOneProcess<float, float>(cloud, size, deal, requests, threads, values);
  }
  else
  {
    ranks::expectSameAsOneProcess<double, double>(cloud, size, deal, requests, threads, values);
  }
}

} // namespace

TEST(RanksRandom, YieldWhatOneProcessDoes)
{
  const std::uint64_t first = numberFrom("RANKS_FIRST_SEED", 1);
  const std::uint64_t count = numberFrom("RANKS_SEEDS", 100);
  for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed)
  {
    checkOne(seed);
  }
}
