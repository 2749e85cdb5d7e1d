// SPDX-License-Identifier: GPL-3.0-or-later
// The core against the definition (BruteForce.h): every isopoint is equal, bit for bit.
#include "BruteForce.h"
#include "Clouds.h"
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

clouds::Cloud timesPositions(double factor, const clouds::Cloud& cloud, double offset = 0.0)
{
  return clouds::moved(cloud,
    [=](double* p) { std::for_each(p, p + 3, [=](double& c) { c = offset + factor * c; }); });
}

/// A cloud around the origin at any scale.
clouds::Cloud scaledCloud(double scale, std::uint64_t seed)
{
  return timesPositions(scale, timesPositions(1.0, clouds::uniform(400, seed), -0.5));
}

} // namespace

TEST(CanonicalResult, Uniform)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    EXPECT_GT(compare(clouds::uniform(700, seed), { -0.5, 0.3 }), 0u);
  }
  // Large enough for every path of splitting.
  EXPECT_GT(compare(clouds::uniform(12000, 4), { 0.4 }, { isopoint::defaultAngle }), 0u);
}

TEST(CanonicalResult, ClusteredOrInALattice)
{
  EXPECT_GT(compare(clouds::clustered(1500, 5), { -4.0, 0.0 }), 0u);
  EXPECT_GT(compare(clouds::lattice(9, 10, 11), { 0.0, 2.0, 2.5 }), 0u);
  EXPECT_GT(compare(clouds::lattice(8, 8, 8), { 1.0 }), 0u);
}

TEST(CanonicalResult, SharedPlanesLinesAndPositions)
{
  for (const int steps : { 2, 3, 5, 9 })
  {
    EXPECT_GT(compare(clouds::coarse(600, steps, 6), { 4.5, 5.0 }), 0u);
  }
  EXPECT_GT(compare(clouds::flattened(clouds::uniform(500, 7), 2), { 0.4 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::uniform(500, 8), 1), { 0.9 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::coarse(500, 7, 9), 2), { 5.0 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::coarse(500, 50, 9), 1), { 5.0 }), 0u);
  for (const double share : { 0.3, 0.6, 0.9 })
  {
    EXPECT_GT(compare(clouds::coincident(clouds::uniform(500, 10), share), { 0.3 }), 0u);
  }
  EXPECT_EQ(compare(clouds::coincident(clouds::uniform(50, 10), 1.0), { 0.3 }), 0u);
  EXPECT_GT(compare(clouds::nestedCoincident(4096), { 2.0, 3.5 }), 0u);
}

TEST(CanonicalResult, OneCellThatTouchesManyOthers)
{
  const clouds::Cloud cloud = clouds::layerBeforeOne(800, 17);
  const bruteforce::Tree tree(cloud);
  std::size_t largest = 0;
  for (const std::vector<std::size_t>& neighbors : bruteforce::neighborhoods(tree.cells))
  {
    largest = std::max(largest, neighbors.size());
  }
  EXPECT_GT(largest, cloud.size() / 3);
  EXPECT_GT(compare(cloud, { 0.5 }), 0u);
  EXPECT_GT(compare(clouds::coincident(cloud, 0.2), { 0.5 }), 0u);
}

TEST(CanonicalResult, NeighborhoodsThatAddUpToMoreThanCanBeListed)
{
  const auto sumOfLargeNeighborhoods = [](const clouds::Cloud& cloud)
  {
    std::size_t sum = 0;
    for (const auto& neighbors : bruteforce::neighborhoods(bruteforce::Tree(cloud).cells))
    {
      sum += neighbors.size() > 64 ? neighbors.size() : 0;
    }
    return sum;
  };
  clouds::Random random(20);
  const auto anyAngles = [&random]() -> std::vector<double>
  {
    return { 60.0 * random() + 1.0, isopoint::defaultAngle, 90.0 * random() + 60.0,
      30.0 * random() + 150.0 };
  };
  const auto check = [&](const clouds::Cloud& cloud, const std::vector<double>& isovalues)
  {
    EXPECT_GT(sumOfLargeNeighborhoods(cloud), 2 * cloud.size());
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
  for (const double scale : { 1e-310, 1e-160, 1e-30, 1e-9, 1e9, 1e30, 1e150, 1e307 })
  {
    EXPECT_GT(compare(scaledCloud(scale, 18), { 0.3 }), 0u) << scale;
  }
  EXPECT_GT(compare(timesPositions(1e-2, clouds::uniform(400, 13), 1e9), { 0.3 }), 0u);
}

TEST(CanonicalResult, SignedZerosCoincide)
{
  clouds::Cloud cloud = clouds::coarse(300, 3, 19);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
  {
    double& coordinate = cloud.positions[i];
    coordinate = i / 3 % 2 && coordinate == 0.0 ? -0.0 : coordinate;
  }
  EXPECT_GT(compare(cloud, { 5.0 }), 0u);
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

TEST(CanonicalResult, SortedInput)
{
  clouds::Cloud sorted;
  for (int i = 0; i < 1000; ++i)
  {
    sorted.add(0.001 * i, (i * 37) % 101, (i * 53) % 97, clouds::waves(0.001 * i, i % 7, 0.0));
  }
  EXPECT_GT(compare(sorted, { 0.5 }), 0u);
}

TEST(CanonicalResult, EverySampleLayout)
{
  clouds::Cloud cloud = clouds::uniform(800, 11);
  for (std::vector<double>* const numbers : { &cloud.positions, &cloud.values })
  {
    std::for_each(numbers->begin(), numbers->end(),
      [](double& number) { number = static_cast<float>(number); });
  }
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
    double largest = 0.0;
    for (const isopoint::Vector& position : surface.positions)
    {
      largest = std::max(largest, std::abs(isopoint::lengthOf(position) - 70.0));
    }
    EXPECT_LE(largest, coarser * deviation) << angle;
    EXPECT_LT(surface.edges.size(), fewer) << angle;
    fewer = surface.edges.size();
  }
  EXPECT_GT(fewer, 3000u);
}
