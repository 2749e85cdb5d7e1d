// SPDX-License-Identifier: GPL-3.0-or-later
// How far samples extend ahead of a place, against the definition (docs/algorithm.md,
// section 12.4).
#include "Clouds.h"

#include "Core/Base/Vector.h"
#include "Core/Extraction/NarrowBand.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Neighbors/SampleExtent.h"
#include "Core/Tree/Loading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

using isopoint::ExtentQuery;
using isopoint::Vector;

namespace
{

using Tree = isopoint::SampleTree<isopoint::WideSample>;

Tree loaded(const clouds::Cloud& cloud)
{
  return isopoint::loadSamples<isopoint::WideSample>(
    clouds::executionOn(2), cloud.size(), clouds::readerOf(cloud));
}

/// E of section 12.4, over all samples; no more than the query's `enough`.
double extentByBruteForce(const clouds::Cloud& cloud, const ExtentQuery& query)
{
  double above = 0.0;
  double below = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double* const p = &cloud.positions[3 * i];
    const Vector offset = isopoint::difference({ p[0], p[1], p[2] }, query.place);
    const double length = isopoint::lengthOf(offset);
    const double ahead = isopoint::dot(offset, query.direction);
    if (length <= query.reach && ahead >= 0.7071 * length)
    {
      const double height = isopoint::dot(offset, query.normal);
      above = height >= 0.0 ? std::max(above, ahead) : above;
      below = height <= 0.0 ? std::max(below, ahead) : below;
    }
  }
  return std::min({ above, below, query.enough });
}

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// The number of the nearest sample that stands ahead by `enough` or more, the lowest of equals.
std::size_t nearestByBruteForce(const clouds::Cloud& cloud, const ExtentQuery& query)
{
  std::size_t nearest = none;
  double least = query.reach;
  for (std::size_t i = cloud.size(); i-- > 0;)
  {
    const double* const p = &cloud.positions[3 * i];
    const Vector offset = isopoint::difference({ p[0], p[1], p[2] }, query.place);
    const double length = isopoint::lengthOf(offset);
    const double ahead = isopoint::dot(offset, query.direction);
    if (length <= least && ahead >= query.enough && ahead >= 0.7071 * length)
    {
      least = length;
      nearest = i;
    }
  }
  return nearest;
}

/// The number of the sample nearest to a place within reach, the lowest of equals.
std::size_t closestByBruteForce(const clouds::Cloud& cloud, const Vector& place, double reach)
{
  std::size_t closest = none;
  double least = reach;
  for (std::size_t i = cloud.size(); i-- > 0;)
  {
    const double* const p = &cloud.positions[3 * i];
    const double length = isopoint::lengthOf(isopoint::difference({ p[0], p[1], p[2] }, place));
    if (length <= least)
    {
      least = length;
      closest = i;
    }
  }
  return closest;
}

std::vector<ExtentQuery> randomQueries(const clouds::Cloud& cloud, int count)
{
  clouds::Random random(11);
  const auto direction = [&random]() {
    return isopoint::directionOf({ random() - 0.5, random() - 0.5, random() - 0.5 });
  };
  std::vector<ExtentQuery> queries;
  for (int i = 0; i < count; ++i)
  {
    const auto sample = static_cast<std::size_t>(random() * static_cast<double>(cloud.size()));
    const double* const p = &cloud.positions[3 * sample];
    const double reach = 0.01 + 0.5 * random();
    const Vector normal = direction();
    const auto across = isopoint::extentDirections(normal);
    queries.push_back({ { p[0], p[1], p[2] }, normal, across[static_cast<std::size_t>(i) % 8],
      reach * (0.05 + 0.9 * random()), reach });
  }
  return queries;
}

} // namespace

TEST(SampleExtent, EqualsBruteForceHoweverMuchOfTheTreeIsRefined)
{
  int limited = 0;
  int found = 0;
  clouds::Cloud coarse = clouds::coarse(3000, 10, 6); // many samples are equally far
  for (double& coordinate : coarse.positions)
  {
    coordinate *= 0.125;
  }
  for (const clouds::Cloud& cloud : { clouds::uniform(3000, 1), clouds::clustered(3000, 2),
         clouds::coincident(clouds::uniform(3000, 3), 0.3), clouds::lines(3000, 3, 0, 5), coarse })
  {
    Tree tree = loaded(cloud);
    const std::vector<ExtentQuery> queries = randomQueries(cloud, 400);
    // The first isosurface is empty and refines nothing; two others refine different parts.
    for (const double isovalue : { 1e9, 0.5, -0.4 })
    {
      const isopoint::Execution execution = clouds::executionOn(2);
      isopoint::SingleRank<isopoint::WideSample> rank(tree);
      isopoint::NarrowBand<isopoint::WideSample>(tree, isovalue, execution).refine(rank);
      const isopoint::SampleExtents extents(tree);
      for (const ExtentQuery& query : queries)
      {
        const double expected = extentByBruteForce(cloud, query);
        EXPECT_DOUBLE_EQ(extents.at(query), expected);
        limited += expected > 0.0 && expected < query.enough ? 1 : 0;
        const isopoint::WideSample* const nearest = extents.nearest(query);
        EXPECT_EQ(nearest ? nearest->id : none, nearestByBruteForce(cloud, query));
        found += nearest ? 1 : 0;
        const Vector ahead = isopoint::sum(query.place, query.enough, query.direction);
        const isopoint::WideSample* const closest = extents.nearestTo(ahead, query.enough);
        EXPECT_EQ(closest ? closest->id : none, closestByBruteForce(cloud, ahead, query.enough));
      }
    }
  }
  EXPECT_GT(limited, 300);
  EXPECT_GT(found, 1000);
}

// Where a surface leaves the samples at a grazing angle, they are ahead on one side of it only.
TEST(SampleExtent, IsTheSmallerOneOfBothSidesOfTheTangentPlane)
{
  clouds::Cloud cloud;
  for (int x = -5; x <= 5; ++x)
  {
    for (int y = -5; y <= 5; ++y)
    {
      for (int z = -5; z <= (x <= 1 ? 5 : 0); ++z)
      {
        cloud.add(x, y, z, z);
      }
    }
  }
  const Tree tree = loaded(cloud);
  const auto extentTowards = [&](const Vector& direction)
  {
    return isopoint::SampleExtents(tree).at(
      { { 0.0, 0.0, 0.5 }, { 0.0, 0.0, 1.0 }, direction, 3.5, 5.0 });
  };
  EXPECT_DOUBLE_EQ(extentTowards({ 1.0, 0.0, 0.0 }), 1.0);
  EXPECT_DOUBLE_EQ(extentTowards({ -1.0, 0.0, 0.0 }), 3.5);
}

TEST(SampleExtent, OfNoSamplesIsZero)
{
  const Tree empty;
  const ExtentQuery query{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, 1.0, 2.0 };
  EXPECT_EQ(isopoint::SampleExtents(empty).at(query), 0.0);
  EXPECT_EQ(isopoint::SampleExtents(empty).nearest(query), nullptr);
  EXPECT_EQ(isopoint::SampleExtents(empty).nearestTo(query.place, 1.0), nullptr);
}
