// SPDX-License-Identifier: GPL-3.0-or-later
// Random clouds, options and ranks. The environment variables RANKS_FIRST_SEED and RANKS_SEEDS
// choose others than the first hundred. The points of all ranks are those of one process.
#include "RandomClouds.h"
#include "RankTesting.h"

#include <gtest/gtest.h>

#include <string>

namespace
{

using clouds::Cloud;
using clouds::Dice;
using clouds::numberFrom;
using clouds::randomCloud;

isopoint::ExtractionRequest randomRequest(Dice& dice)
{
  using isopoint::FitOrder;
  constexpr double angles[] = { 54.7, 54.7, 54.7, 0.0, 30.0, 120.0, 180.0 };
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 3.0 * dice.real() - 1.0;
  request.isosurface.angle = angles[dice(7)];
  request.isosurface.dropsGaps = dice(2) == 0;
  const std::size_t order = dice(7);
  if (order > 0)
  {
    request.isosurface.fit = isopoint::FitRequest{ std::nullopt, false };
  }
  if (order > 1)
  {
    request.isosurface.fit =
      isopoint::FitRequest{ static_cast<FitOrder>(std::min<std::size_t>(order - 1, 4)),
        dice(3) > 0 };
    request.minimumSpacing = dice(3) == 0 ? dice.real() : 0.0;
  }
  if (dice(4) > 0)
  {
    request.splats =
      isopoint::SplatOptions{ 3 + static_cast<int>(dice(12)), dice(5) > 0, dice(5) > 0 };
  }
  return request;
}

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
