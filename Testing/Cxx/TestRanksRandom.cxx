// SPDX-License-Identifier: GPL-3.0-or-later
// Random clouds, options and ranks. The environment variables RANKS_FIRST_SEED and RANKS_SEEDS
// choose others than the first hundred. The points of all ranks are those of one process.
#include "RankTesting.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace
{

using clouds::Cloud;

/// Whole numbers below a limit.
class Dice
{
public:
  explicit Dice(std::uint64_t seed)
    : Uniform(seed)
  {
  }

  std::size_t operator()(std::size_t limit)
  {
    return std::min(
      limit - 1, static_cast<std::size_t>(this->Uniform() * static_cast<double>(limit)));
  }
  double real() { return this->Uniform(); }

private:
  clouds::Random Uniform;
};

Cloud randomCloud(Dice& dice, std::uint64_t seed)
{
  const std::size_t count = std::size_t{ 1 } << dice(12);
  const std::size_t some = count + dice(count + 1);
  switch (dice(12))
  {
    case 0:
      return clouds::clustered(some, seed);
    case 1:
      return clouds::lattice(2 + static_cast<int>(dice(11)), 1 + static_cast<int>(dice(11)),
        1 + static_cast<int>(dice(11)));
    case 2:
      return clouds::coarse(some, 2 + static_cast<int>(dice(9)), seed);
    case 3:
      return clouds::coincident(clouds::uniform(some, seed), dice.real());
    case 4:
      return clouds::lines(some / 2 + 1, 1 + dice(8), static_cast<int>(dice(50)), seed);
    case 5:
      return clouds::combs(some / 2 + 1, 1 + static_cast<int>(dice(12)), seed);
    case 6:
      return clouds::curves(some / 2 + 1, seed);
    case 7:
      return clouds::flattened(clouds::uniform(some, seed), static_cast<int>(dice(3)));
    case 8:
      return clouds::nestedCoincident(some / 4 + 10);
    case 9:
      return clouds::layerBeforeOne(some / 4 + 10, seed);
    default:
      return clouds::uniform(some, seed);
  }
}

isopoint::ExtractionRequest randomRequest(Dice& dice)
{
  using isopoint::FitOrder;
  constexpr double angles[] = { 54.7, 54.7, 54.7, 0.0, 30.0, 120.0, 180.0 };
  constexpr double gaps[] = { 0.0, 0.0, 1.0, 2.0, 4.0 };
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 3.0 * dice.real() - 1.0;
  request.isosurface.angle = angles[dice(7)];
  request.isosurface.gapFactor = gaps[dice(5)];
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

/// A number from the environment, which makes the test run longer than usual.
std::uint64_t numberFrom(const char* name, std::uint64_t usual)
{
  const char* const text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : usual;
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
