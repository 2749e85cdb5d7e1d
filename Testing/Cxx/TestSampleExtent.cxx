// SPDX-License-Identifier: GPL-3.0-or-later
// How far samples extend ahead of a place, against the definition (docs/algorithm.md,
// section 12.4).
#include "Clouds.h"

#include "Core/Extraction/NarrowBand.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Neighbors/SampleExtent.h"
#include "Core/Tree/Loading.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;
using Tree = SampleTree<WideSample>;

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// By looking at all samples; of equally near ones the lowest counts.
struct BruteForce
{
  double extent;              // E of section 12.4, no more than the query's `enough`
  std::size_t nearest = none; // that is ahead by `enough` or more
  std::size_t closest = none; // to the place ahead by `enough`, no farther than that

  BruteForce(const clouds::Cloud& cloud, const ExtentQuery& query)
  {
    double above = 0.0;
    double below = 0.0;
    double minLength = query.reach;
    double minDistance = query.enough;
    const Vector place = query.position + query.enough * query.direction;
    for (std::size_t i = cloud.size(); i-- > 0;)
    {
      const Vector offset = cloud.at(i) - query.position;
      const double length = lengthOf(offset);
      const double ahead = dot(offset, query.direction);
      if (length <= query.reach && ahead >= 0.7071 * length)
      {
        const double height = dot(offset, query.normal);
        above = height >= 0.0 ? std::max(above, ahead) : above;
        below = height <= 0.0 ? std::max(below, ahead) : below;
        if (length <= minLength && ahead >= query.enough)
        {
          minLength = length;
          this->nearest = i;
        }
      }
      const double distance = lengthOf(cloud.at(i) - place);
      if (distance <= minDistance)
      {
        minDistance = distance;
        this->closest = i;
      }
    }
    this->extent = std::min({ above, below, query.enough });
  }
};

std::vector<ExtentQuery> randomQueries(const clouds::Cloud& cloud, std::size_t count)
{
  clouds::Random random(11);
  std::vector<ExtentQuery> queries;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto sample = static_cast<std::size_t>(random() * static_cast<double>(cloud.size()));
    const double reach = 0.01 + 0.5 * random();
    const Vector normal = directionOf(random.inCube(1.0));
    queries.push_back({ cloud.at(sample), normal, extentDirections(normal)[i % 8],
      reach * (0.05 + 0.9 * random()), reach });
  }
  return queries;
}

} // namespace

TEST(SampleExtent, EqualsBruteForceHoweverMuchOfTheTreeIsRefined)
{
  int limited = 0;
  int found = 0;
  for (const clouds::Cloud& cloud : { clouds::uniform(3000, 1), clouds::clustered(3000, 2),
         clouds::coincident(clouds::uniform(3000, 3), 0.3), clouds::lines(3000, 3, 0, 5),
         clouds::scaled(clouds::coarse(3000, 10, 6), 0.125, 0.125, 0.125) }) // many equally far
  {
    const Execution execution = clouds::executionOn(2);
    Tree tree = loadSamples<WideSample>(execution, cloud.size(), clouds::readerOf(cloud));
    const std::vector<ExtentQuery> queries = randomQueries(cloud, 400);
    // The first isosurface is empty and refines nothing; two others refine different parts.
    for (const double isovalue : { 1e9, 0.5, -0.4 })
    {
      SingleRank<WideSample> rank(tree);
      NarrowBand<WideSample>(tree, isovalue, execution).refine(rank);
      const SampleExtents extents(tree);
      const auto idOf = [](const WideSample* sample) { return sample ? sample->id : none; };
      for (const ExtentQuery& query : queries)
      {
        const BruteForce expected(cloud, query);
        const Vector ahead = query.position + query.enough * query.direction;
        EXPECT_DOUBLE_EQ(extents.at(query), expected.extent);
        EXPECT_EQ(idOf(extents.nearest(query)), expected.nearest);
        EXPECT_EQ(idOf(extents.nearestTo(ahead, query.enough)), expected.closest);
        limited += expected.extent > 0.0 && expected.extent < query.enough ? 1 : 0;
        found += expected.nearest != none ? 1 : 0;
      }
    }
  }
  EXPECT_GT(limited, 300);
  EXPECT_GT(found, 1000);
}

TEST(SampleExtent, OfNoSamplesIsZero)
{
  const Tree empty;
  const ExtentQuery query{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, 1.0, 2.0 };
  EXPECT_EQ(SampleExtents(empty).at(query), 0.0);
  EXPECT_EQ(SampleExtents(empty).nearest(query), nullptr);
  EXPECT_EQ(SampleExtents(empty).nearestTo(query.position, 1.0), nullptr);
}
