// SPDX-License-Identifier: GPL-3.0-or-later
// The gap criterion: against the definition, and against voids and domains of known shape.
#include "IsopointTesting.h"

#include "Core/Neighbors/AngleCriterion.h"
#include "Core/Neighbors/GapCriterion.h"
#include "Core/Tree/Loading.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/TreeRefinement.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;
using isopointtesting::expectSameIsopoints;

constexpr double isovalue = 0.3;

/// The samples beside an empty slab.
clouds::Cloud withVoid(std::size_t count, std::uint64_t seed)
{
  return clouds::filtered(clouds::uniform(count, seed),
    [](const clouds::Vector& p) { return p[0] <= 0.3 || p[0] >= 0.7; });
}

/// Compares the criterion with the definition, on all pairs of samples.
/// @returns the number of edges that are dropped with the smallest factor
std::size_t expectTheDefinition(const clouds::Cloud& cloud)
{
  const bruteforce::Tree expected(cloud);
  auto tree = loadSamples<WideSample>({}, cloud.size(), clouds::readerOf(cloud));
  splitCompletely({}, tree, { rootNode });
  SampleBounds<WideSample> bounds(tree);
  std::map<std::uint64_t, std::size_t> leafOf; // by id
  Path path = pathToRoot(tree);
  forEachBelow(tree, path, maximumDepth,
    [&](const Path& leaf)
    { leafOf[tree.samples[tree.nodes[leaf.nodeIndex()].begin].id] = leaf.nodeIndex(); });
  const auto sampleOf = [&](std::size_t leaf) -> const WideSample&
  { return tree.samples[tree.nodes[leaf].begin]; };
  std::size_t dropped = 0;
  for (const double factor : { 5.0, 2.0, 1.3, 1.0, 0.7, 0.1 })
  {
    dropped = 0;
    for (std::size_t x = 0; x < expected.cells.size(); ++x)
    {
      const std::size_t leaf = leafOf.at(expected.cells[x].id);
      const Path at = pathToNode(tree, leaf);
      for (std::size_t y = x + 1; y < expected.cells.size(); y += 1 + x % 7)
      {
        const std::size_t wanted = 1 + (x + y) % 3;
        const GapCriterion criterion(factor, wanted);
        const WideSample& other = sampleOf(leafOf.at(expected.cells[y].id));
        const bool isDropped = criterion.rejects(tree, bounds, sampleOf(leaf), other);
        EXPECT_EQ(isDropped, bruteforce::isDroppedByGap(
                               expected.cells, x, y, factor, static_cast<std::ptrdiff_t>(wanted)));
        if (isDropped)
        {
          const Offset edge = offsetBetween(positionOf(sampleOf(leaf)), positionOf(other));
          EXPECT_TRUE(criterion.mayReject(tree, at, sampleOf(leaf), edge.length));
        }
        dropped += isDropped ? 1 : 0;
      }
    }
  }
  return dropped;
}

/// @returns the number of isopoints that are dropped
std::size_t expectDroppedIsopoints(const clouds::Cloud& cloud, double value, double angle)
{
  const auto expected = bruteforce::extract(cloud, value, angle, true);
  expectSameIsopoints(expected, clouds::extract(cloud, value, angle, 2, true).edges);
  return clouds::extract(cloud, value, angle).edges.size() - expected.size();
}

std::vector<IsopointEdge> edgesOf(const clouds::Cloud& cloud, double value, bool dropsGaps)
{
  return clouds::extract(cloud, value, defaultAngle, 2, dropsGaps).edges;
}

} // namespace

TEST(Gaps, DropWhatTheDefinitionDrops)
{
  EXPECT_GT(expectTheDefinition(clouds::uniform(300, 21)), 0u);
  EXPECT_GT(expectTheDefinition(withVoid(500, 22)), 0u);
  EXPECT_GT(expectTheDefinition(clouds::clustered(300, 23)), 0u);
  EXPECT_GT(expectTheDefinition(clouds::lattice(6, 7, 7)), 0u);
  EXPECT_GT(expectTheDefinition(clouds::coarse(300, 5, 24)), 0u);
  EXPECT_GT(expectTheDefinition(clouds::coincident(clouds::uniform(250, 25), 0.6)), 0u);
  EXPECT_GT(expectTheDefinition(clouds::flattened(clouds::uniform(300, 26), 2)), 0u);
  for (std::size_t count = 1; count <= 9; ++count)
  {
    expectTheDefinition(clouds::uniform(count, count));
  }
}

TEST(Gaps, DropIsopointsOnEdgesConnectedWithStrongOnes)
{
  for (const double angle : { 0.0, defaultAngle, 90.0 })
  {
    EXPECT_GT(expectDroppedIsopoints(withVoid(3000, 22), isovalue, angle), 0u);
    expectDroppedIsopoints(clouds::clustered(900, 23), -4.0, angle);
    expectDroppedIsopoints(clouds::lattice(9, 10, 11), 2.0, angle);
    expectDroppedIsopoints(clouds::coincident(clouds::uniform(500, 25), 0.6), isovalue, angle);
  }
}

TEST(Gaps, DropEdgesAcrossAVoidAndFewOthers)
{
  for (const std::size_t count : { 20000, 100000 })
  {
    const clouds::Cloud cloud = withVoid(count, 27);
    const auto isAcross = [&cloud](const IsopointEdge& edge)
    { return (cloud.at(edge.first)[0] > 0.5) != (cloud.at(edge.second)[0] > 0.5); };
    const std::vector<IsopointEdge> all = edgesOf(cloud, isovalue, false);
    const std::vector<IsopointEdge> kept = edgesOf(cloud, isovalue, true);
    const std::size_t across = clouds::countOf(all, isAcross);
    EXPECT_GT(across, 20u);
    EXPECT_EQ(clouds::countOf(kept, isAcross), 0u);
    EXPECT_GT(static_cast<double>(kept.size()), 0.99 * static_cast<double>(all.size() - across));
  }
}

TEST(Gaps, DropNextToNothingWhereThereIsNoVoid)
{
  const auto keptShare = [](const clouds::Cloud& cloud, double value)
  {
    const std::size_t all = edgesOf(cloud, value, false).size();
    EXPECT_GT(all, 100u);
    return static_cast<double>(edgesOf(cloud, value, true).size()) / static_cast<double>(all);
  };
  EXPECT_EQ(keptShare(clouds::uniform(20000, 28), isovalue), 1.0);
  EXPECT_EQ(keptShare(clouds::lattice(30, 31, 32), 2.0), 1.0);

  // Samples on lines that are a hundred times farther apart than samples on a line, and on slices,
  // jittered along these.
  const auto stretched = [](int nx, int ny, int nz)
  {
    const int counts[] = { nx, ny, nz };
    clouds::Cloud cloud = clouds::lattice(nx, ny, nz);
    clouds::Random random(29);
    for (std::size_t i = 0; i < cloud.positions.size(); ++i)
    {
      double& coordinate = cloud.positions[i];
      const int count = counts[i % 3];
      coordinate = (coordinate + (count > 10 ? 0.8 * random() : 0.0)) / count;
    }
    return clouds::withValuesOf(cloud, clouds::waves);
  };
  EXPECT_GT(keptShare(stretched(10, 10, 1000), isovalue), 0.999);
  // A few edges are so oblique that samples of their end's own slice lie behind it.
  EXPECT_GT(keptShare(stretched(150, 150, 10), isovalue), 0.95);
}

// Cell centers of a grid one half of which is four times finer.
TEST(Gaps, DropNothingWhereCoarseCellsMeetFineOnes)
{
  clouds::Cloud cloud;
  const auto fill = [&cloud](double lower, int count)
  {
    for (int i = 0; i < count * count * count / 2; ++i)
    {
      const clouds::Vector p{ lower + (i / count / count + 0.5) / count,
        (i / count % count + 0.5) / count, (i % count + 0.5) / count };
      cloud.add(p, clouds::waves(p));
    }
  };
  fill(0.0, 8);
  fill(0.5, 32);
  const std::size_t all = edgesOf(cloud, isovalue, false).size();
  EXPECT_GT(all, 1000u);
  EXPECT_EQ(edgesOf(cloud, isovalue, true).size(), all);
}
