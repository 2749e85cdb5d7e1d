// SPDX-License-Identifier: GPL-3.0-or-later
// The core against the definition (BruteForce.h): every isopoint is equal, bit for bit.
#include "FitTesting.h"
#include "IsopointTesting.h"

#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

namespace
{

using isopointtesting::expectSameIsopoints;

/// @returns the number of isopoints compared
std::size_t compare(const clouds::Cloud& cloud, const std::vector<double>& isovalues,
  const std::vector<double>& angles = { 0.0, 30.0, isopoint::defaultAngle, 80.0, 90.0, 180.0 })
{
  std::size_t count = 0;
  for (const double isovalue : isovalues)
  {
    for (const double angle : angles)
    {
      SCOPED_TRACE(testing::Message() << "isovalue " << isovalue << ", angle " << angle);
      const auto expected = bruteforce::extract(cloud, isovalue, angle);
      expectSameIsopoints(expected, clouds::extract(cloud, isovalue, angle).edges);
      count += expected.size();
    }
  }
  return count;
}

/// The total size of the neighborhoods with more than `least` cells.
std::size_t sumOfNeighborhoods(const clouds::Cloud& cloud, std::size_t least)
{
  std::size_t sum = 0;
  for (const auto& neighbors : bruteforce::neighborhoods(bruteforce::Tree(cloud).cells))
  {
    sum += neighbors.size() > least ? neighbors.size() : 0;
  }
  return sum;
}

clouds::Cloud timesPositions(double factor, const clouds::Cloud& cloud, double offset = 0.0)
{
  return clouds::moved(cloud,
    [=](double* p) { std::for_each(p, p + 3, [=](double& c) { c = offset + factor * c; }); });
}

} // namespace

TEST(CanonicalResult, OfCloudsOfEveryKind)
{
  clouds::Cloud signedZeros = clouds::coarse(300, 3, 19); // they coincide
  for (std::size_t i = 0; i < signedZeros.positions.size(); ++i)
  {
    double& coordinate = signedZeros.positions[i];
    coordinate = i / 3 % 2 && coordinate == 0.0 ? -0.0 : coordinate;
  }
  clouds::Cloud sorted;
  for (int i = 0; i < 1000; ++i)
  {
    sorted.add(
      0.001 * i, (i * 37) % 101, (i * 53) % 97, clouds::waves({ 0.001 * i, 1.0 * (i % 7), 0.0 }));
  }
  const std::vector<std::pair<clouds::Cloud, std::vector<double>>> cases{
    { clouds::uniform(700, 1), { -0.5, 0.3 } },
    { clouds::uniform(700, 2), { -0.5, 0.3 } },
    { clouds::uniform(700, 3), { -0.5, 0.3 } },
    { clouds::clustered(1500, 5), { -4.0, 0.0 } },
    { clouds::lattice(9, 10, 11), { 0.0, 2.0, 2.5 } },
    { clouds::lattice(8, 8, 8), { 1.0 } },
    { clouds::coarse(600, 2, 6), { 4.5, 5.0 } },
    { clouds::coarse(600, 3, 6), { 4.5, 5.0 } },
    { clouds::coarse(600, 5, 6), { 4.5, 5.0 } },
    { clouds::coarse(600, 9, 6), { 4.5, 5.0 } },
    { clouds::flattened(clouds::uniform(500, 7), 2), { 0.4 } },
    { clouds::flattened(clouds::uniform(500, 8), 1), { 0.9 } },
    { clouds::flattened(clouds::coarse(500, 7, 9), 2), { 5.0 } },
    { clouds::flattened(clouds::coarse(500, 50, 9), 1), { 5.0 } },
    { clouds::coincident(clouds::uniform(500, 10), 0.3), { 0.3 } },
    { clouds::coincident(clouds::uniform(500, 10), 0.6), { 0.3 } },
    { clouds::coincident(clouds::uniform(500, 10), 0.9), { 0.3 } },
    { clouds::nestedCoincident(4096), { 2.0, 3.5 } },
    { signedZeros, { 5.0 } },
    { sorted, { 0.5 } },
    { timesPositions(1e-2, clouds::uniform(400, 13), 1e9), { 0.3 } },
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    SCOPED_TRACE(i);
    EXPECT_GT(compare(cases[i].first, cases[i].second), 0u);
  }
  EXPECT_EQ(compare(clouds::coincident(clouds::uniform(50, 10), 1.0), { 0.3 }), 0u);
  // Large enough for every path of splitting.
  EXPECT_GT(compare(clouds::uniform(12000, 4), { 0.4 }, { isopoint::defaultAngle }), 0u);
}

TEST(CanonicalResult, OneCellThatTouchesManyOthers)
{
  const clouds::Cloud cloud = clouds::layerBeforeOne(800, 17);
  EXPECT_GT(sumOfNeighborhoods(cloud, cloud.size() / 3), 0u);
  EXPECT_GT(compare(cloud, { 0.5 }), 0u);
  EXPECT_GT(compare(clouds::coincident(cloud, 0.2), { 0.5 }), 0u);
}

TEST(CanonicalResult, NeighborhoodsThatAddUpToMoreThanCanBeListed)
{
  clouds::Random random(20);
  const auto anyAngles = [&random]() -> std::vector<double>
  {
    return { 60.0 * random() + 1.0, isopoint::defaultAngle, 90.0 * random() + 60.0,
      30.0 * random() + 150.0 };
  };
  const auto check = [&](const clouds::Cloud& cloud, const std::vector<double>& isovalues)
  {
    EXPECT_GT(sumOfNeighborhoods(cloud, 64), 2 * cloud.size());
    EXPECT_GT(compare(cloud, isovalues, anyAngles()), 0u);
    EXPECT_GT(compare(clouds::coincident(cloud, 0.2), isovalues, anyAngles()), 0u);
  };
  for (std::uint64_t seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    for (const std::size_t lineCount : { 2, 3, 4 })
    {
      SCOPED_TRACE(lineCount);
      check(clouds::lines(700, lineCount, 0, seed), { 0.0, 0.4 });
    }
    check(clouds::lines(1200, 3, 512, seed), { 0.0 });
    check(clouds::combs(900, 3, seed), { 0.0, 0.3 });
    check(clouds::curves(900, seed), { 0.0, 0.6 });
  }
}

TEST(CanonicalResult, ExtremeCoordinates)
{
  const clouds::Cloud cloud = timesPositions(1.0, clouds::uniform(400, 18), -0.5);
  for (const double scale : { 1e-310, 1e-160, 1e-30, 1e-9, 1e9, 1e30, 1e150, 1e307 })
  {
    EXPECT_GT(compare(timesPositions(scale, cloud), { 0.3 }), 0u) << scale;
  }
  for (const auto& [most, few] : { std::pair(1.0, 1e300), { 1e300, 1.0 }, { 1e-150, 1e150 } })
  {
    clouds::Cloud mixed = timesPositions(most, cloud);
    std::for_each(mixed.positions.begin(), mixed.positions.begin() + 30,
      [factor = few / most](double& coordinate) { coordinate *= factor; });
    EXPECT_GT(compare(mixed, { 0.3 }), 0u) << most << few;
  }
}

TEST(CanonicalResult, Tiny)
{
  std::size_t isopoints = 0;
  for (std::size_t count = 0; count <= 9; ++count)
  {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
      isopoints += compare(clouds::uniform(count, seed), { 0.5 });
      isopoints += compare(clouds::coarse(count, 2, seed), { 5.0 });
    }
  }
  EXPECT_GT(isopoints, 100u);
}

TEST(CanonicalResult, EverySampleLayout)
{
  const clouds::Cloud cloud = clouds::roundedToFloat(clouds::uniform(800, 11));
  const auto expected = bruteforce::extract(cloud, 0.25, isopoint::defaultAngle);
  EXPECT_FALSE(expected.empty());
  expectSameIsopoints(expected, clouds::extract<float, float>(cloud, 0.25).edges);
  expectSameIsopoints(expected, clouds::extract<float, double>(cloud, 0.25).edges);
  expectSameIsopoints(expected, clouds::extract<double, float>(cloud, 0.25).edges);
  expectSameIsopoints(expected, clouds::extract<double, double>(cloud, 0.25).edges);
}

TEST(CanonicalResult, IsovaluesThatNoEdgeCrosses)
{
  const clouds::Cloud cloud = clouds::uniform(300, 14);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double isovalue :
    { 1e9, -1e9, infinity, -infinity, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_TRUE(clouds::extract(cloud, isovalue).edges.empty());
  }
}

// The sphere of [RL06], section 9, with fewer samples and no fits: deviations are proportional to
// the square of the sample spacing.
TEST(LinearAccuracy, DeviatesNoMoreThanInTheTableOfRL06)
{
  constexpr std::size_t count = 250000;
  const clouds::Cloud cloud = fittesting::cloudOf(isopoint::lengthOf, count, 200.0);
  const double coarser = std::pow(8e6 / static_cast<double>(count), 2.0 / 3.0);
  std::size_t fewer = count;
  // Angles, and the largest deviations for 8 million samples ([RL06], Table 2).
  for (const auto& [angle, deviation] : { std::pair(15.0, 0.0425), std::pair(35.0, 0.0355),
         std::pair(55.0, 0.0320), std::pair(80.0, 0.0182) })
  {
    const isopoint::Isosurface surface = clouds::extract(cloud, 70.0, angle, 2);
    const double largest = clouds::largestOf(surface.positions,
      [](const isopoint::Vector& p) { return std::abs(isopoint::lengthOf(p) - 70.0); });
    EXPECT_LE(largest, coarser * deviation) << angle;
    EXPECT_LT(surface.edges.size(), fewer) << angle;
    fewer = surface.edges.size();
  }
  EXPECT_GT(fewer, 3000u);
}
