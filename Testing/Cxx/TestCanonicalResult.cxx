// SPDX-License-Identifier: GPL-3.0-or-later
// The core against the definition (BruteForce.h): every isopoint is equal, bit for bit.
#include "BruteForce.h"
#include "Clouds.h"
#include "IsopointTesting.h"

#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

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

clouds::Cloud roundedToFloat(clouds::Cloud cloud)
{
  for (double& coordinate : cloud.positions)
  {
    coordinate = static_cast<float>(coordinate);
  }
  for (double& value : cloud.values)
  {
    value = static_cast<float>(value);
  }
  return cloud;
}

} // namespace

TEST(CanonicalResult, Uniform)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    EXPECT_GT(compare(clouds::uniform(700, seed), { -0.5, 0.3 }), 0u);
  }
}

TEST(CanonicalResult, UniformLargeEnoughForEveryPathOfSplitting)
{
  EXPECT_GT(compare(clouds::uniform(12000, 4), { 0.4 }, { isopoint::defaultAngle }), 0u);
}

TEST(CanonicalResult, Clustered)
{
  EXPECT_GT(compare(clouds::clustered(1500, 5), { -4.0, 0.0 }), 0u);
}

TEST(CanonicalResult, Lattice)
{
  EXPECT_GT(compare(clouds::lattice(9, 10, 11), { 0.0, 2.0, 2.5 }), 0u);
  EXPECT_GT(compare(clouds::lattice(8, 8, 8), { 1.0 }), 0u);
}

TEST(CanonicalResult, SharedPlanesLinesAndPositions)
{
  for (const int steps : { 2, 3, 5, 9 })
  {
    EXPECT_GT(compare(clouds::coarse(600, steps, 6), { 4.5, 5.0 }), 0u);
  }
}

TEST(CanonicalResult, CoplanarAndCollinear)
{
  EXPECT_GT(compare(clouds::flattened(clouds::uniform(500, 7), 2), { 0.4 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::uniform(500, 8), 1), { 0.9 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::coarse(500, 7, 9), 2), { 5.0 }), 0u);
  EXPECT_GT(compare(clouds::flattened(clouds::coarse(500, 50, 9), 1), { 5.0 }), 0u);
}

TEST(CanonicalResult, CoincidentSamples)
{
  for (const double share : { 0.3, 0.6, 0.9 })
  {
    EXPECT_GT(compare(clouds::coincident(clouds::uniform(500, 10), share), { 0.3 }), 0u);
  }
  EXPECT_EQ(compare(clouds::coincident(clouds::uniform(50, 10), 1.0), { 0.3 }), 0u);
}

TEST(CanonicalResult, NestedCoincidentSamples)
{
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
    const bruteforce::Tree tree(cloud);
    const auto neighborhoods = bruteforce::neighborhoods(tree.cells);
    return std::accumulate(neighborhoods.begin(), neighborhoods.end(), std::size_t{ 0 },
      [](std::size_t sum, const auto& neighbors)
      { return sum + (neighbors.size() > 64 ? neighbors.size() : 0); });
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

TEST(CanonicalResult, NearTheLimitsOfDouble)
{
  for (const double scale : { 1e-310, 1e-160, 1e150, 1e307 })
  {
    clouds::Cloud cloud = clouds::uniform(300, 18);
    for (double& coordinate : cloud.positions)
    {
      coordinate = scale * (coordinate - 0.5);
    }
    EXPECT_GT(compare(cloud, { 0.3 }), 0u) << scale;
  }
}

TEST(CanonicalResult, SignedZerosCoincide)
{
  clouds::Cloud cloud = clouds::coarse(300, 3, 19);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double& coordinate = cloud.positions[3 * i + axis];
      coordinate = i % 2 && coordinate == 0.0 ? -0.0 : coordinate;
    }
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
  const clouds::Cloud cloud = roundedToFloat(clouds::uniform(800, 11));
  const auto expected = bruteforce::extract(cloud, 0.25, isopoint::defaultAngle);
  EXPECT_FALSE(expected.empty());
  const auto check = [&](const isopoint::Isosurface& found)
  { expectSameIsopoints(expected, found.edges); };
  check(clouds::extract<float, float>(cloud, 0.25, isopoint::defaultAngle));
  check(clouds::extract<float, double>(cloud, 0.25, isopoint::defaultAngle));
  check(clouds::extract<double, float>(cloud, 0.25, isopoint::defaultAngle));
  check(clouds::extract<double, double>(cloud, 0.25, isopoint::defaultAngle));
}

TEST(CanonicalResult, ExtremeCoordinates)
{
  for (const double scale : { 1e-30, 1e-9, 1e9, 1e30 })
  {
    clouds::Cloud cloud = clouds::uniform(400, 12);
    for (double& coordinate : cloud.positions)
    {
      coordinate = scale * (coordinate - 0.5);
    }
    EXPECT_GT(compare(cloud, { 0.3 }), 0u);
  }
  clouds::Cloud far = clouds::uniform(400, 13);
  for (double& coordinate : far.positions)
  {
    coordinate = 1e9 + 1e-2 * coordinate;
  }
  EXPECT_GT(compare(far, { 0.3 }), 0u);
}

TEST(CanonicalResult, IsovaluesThatNoEdgeCrosses)
{
  const clouds::Cloud cloud = clouds::uniform(300, 14);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double isovalue :
    { 1e9, -1e9, infinity, -infinity, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_TRUE(clouds::extract(cloud, isovalue, isopoint::defaultAngle).edges.empty());
  }
}
