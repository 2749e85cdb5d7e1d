// SPDX-License-Identifier: GPL-3.0-or-later
// The samples around edges, and their order, against the definition (docs/algorithm.md, 10.1).
#include "RingDefinition.h"

#include "Core/Extraction/ExtractIsosurface.h"
#include "Core/Extraction/IndexSet.h"
#include "Core/Extraction/SampleGatherer.h"
#include "Core/Extraction/SingleRank.h"

#include <gtest/gtest.h>

namespace
{

using Sample = isopoint::DoubleSampleOfFloat;
using clouds::Cloud;
using isopoint::FitSample;
using ringdefinition::Rings;

void expectSame(const std::vector<FitSample>& expected, const std::vector<FitSample>& found)
{
  ASSERT_TRUE(std::equal(expected.begin(), expected.end(), found.begin(), found.end(),
    [](const FitSample& a, const FitSample& b)
    { return a.position == b.position && a.value == b.value; }));
}

/// How many edges of each kind there are.
struct Seen
{
  std::size_t edges = 0;
  std::size_t widened = 0;         // a second ring adds samples to
  std::size_t oneEnded = 0;        // with too many neighbors at one end
  std::size_t representatives = 0; // at both
};

/// Compares all edges of an isovalue, in the order of the tree and then backwards, since what is
/// kept from one edge to the next must not matter.
Seen expectTheDefinition(Cloud cloud, double isovalue)
{
  for (double& value : cloud.values)
  {
    value = static_cast<float>(value);
  }
  const Rings rings(cloud);
  const isopoint::Execution execution;
  auto tree = isopoint::loadSamples<Sample>(execution, cloud.size(), clouds::readerOf(cloud));
  isopoint::SingleRank<Sample> rank(tree);
  const auto nodes = isopoint::NarrowBand<Sample>(tree, isovalue, execution).refine(rank);
  isopoint::NeighborhoodCache<Sample::Id> neighborhoods;
  isopoint::ExtractionContext<Sample> context(tree, neighborhoods, isovalue);
  auto found = isopoint::findEdges(execution, context, rank, { isovalue }, nodes);
  std::sort(found.edges.begin(), found.edges.end());
  found.edges.erase(std::unique(found.edges.begin(), found.edges.end()), found.edges.end());
  Seen seen;
  for (const bool areKnown : { false, true }) // the neighborhoods
  {
    if (areKnown)
    {
      isopoint::keepNeighborhoods(execution, found.neighborhoods, tree.nodes.size(), neighborhoods);
      std::reverse(found.edges.begin(), found.edges.end());
    }
    isopoint::SampleGatherer<Sample> gatherer(context);
    seen = {};
    for (const auto& edge : found.edges)
    {
      const std::size_t a = rings.cellOf(edge.first);
      const std::size_t b = rings.cellOf(edge.second);
      const auto first = rings.firstRing(a, b);
      const auto second = rings.secondRing(a, b, isovalue);
      gatherer.gather(edge.firstLeaf, edge.secondLeaf);
      expectSame(rings.samplesOf(first), gatherer.samples());
      EXPECT_EQ(rings.spacing(a, b), gatherer.spacing());
      gatherer.widen();
      expectSame(rings.samplesOf(second), gatherer.samples());
      gatherer.widen(); // again, without effect
      expectSame(rings.samplesOf(second), gatherer.samples());
      const bool areTooMany = rings.neighborsOf(a).size() > 256;
      const bool areOthersTooMany = rings.neighborsOf(b).size() > 256;
      ++seen.edges;
      seen.widened += second.size() > first.size() ? 1 : 0;
      seen.oneEnded += areTooMany != areOthersTooMany ? 1 : 0;
      seen.representatives += areTooMany && areOthersTooMany ? 1 : 0;
      if (testing::Test::HasFatalFailure())
      {
        return seen;
      }
    }
  }
  return seen;
}

/// Two lines at right angles, one above the other.
/// @param steps number of possible places on a line, so that samples coincide; 0: any
Cloud skewLines(std::size_t count, int steps, std::uint64_t seed)
{
  clouds::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double any = random();
    const double place = steps > 0 ? std::floor(steps * any) / steps : any;
    i % 2 == 0 ? cloud.add(0.55, place, 0.8, -random())
               : cloud.add(place, 0.45, 0.2, 1.0 + random());
  }
  return cloud;
}

} // namespace

TEST(SampleGatherer, FollowsTheDefinition)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    SCOPED_TRACE(seed);
    for (const Cloud& cloud : { clouds::uniform(700, seed), clouds::coarse(700, 8, seed),
           clouds::coincident(clouds::uniform(700, seed), 0.3),
           clouds::flattened(clouds::uniform(700, seed), 2), clouds::lattice(8, 9, 10) })
    {
      const Seen seen = expectTheDefinition(cloud, 0.5);
      EXPECT_GT(seen.edges, 30u);
      EXPECT_GT(seen.widened, seen.edges / 2);
    }
    EXPECT_GT(expectTheDefinition(clouds::clustered(700, seed), -4.0).widened, 50u);
  }
}

TEST(SampleGatherer, FollowsTheDefinitionOfMoreEndsThanAreKept)
{
  Cloud cloud = clouds::uniform(9000, 6);
  std::generate(cloud.values.begin(), cloud.values.end(), clouds::Random(7));
  EXPECT_GT(expectTheDefinition(cloud, 0.5).edges, 10000u);
}

TEST(SampleGatherer, FollowsTheDefinitionWhereEndsHaveTooManyNeighbors)
{
  EXPECT_GT(expectTheDefinition(clouds::layerBeforeOne(900, 4), 0.5).oneEnded, 10u);
  std::size_t representatives = 0; // at both ends
  for (const std::uint64_t seed : { 3, 4, 5 })
  {
    representatives += expectTheDefinition(skewLines(1200, 0, seed), 0.1).representatives;
    representatives += expectTheDefinition(skewLines(1200, 2000, seed), 0.1).representatives;
  }
  EXPECT_GT(representatives, 20u);
}

TEST(IndexSet, IsASet)
{
  clouds::Random random(7);
  isopoint::IndexSet<std::uint32_t> set;
  for (int round = 0; round < 300; ++round)
  {
    set.clear();
    std::set<std::uint32_t> expected;
    // A few leaves, or so many that the set grows; close together, or with equal last bits.
    const int count = round % 50 == 0 ? 5000 : static_cast<int>(200 * random());
    const std::uint32_t stride = round % 3 == 0 ? 1 : round % 3 == 1 ? 1024 : 0x10000;
    for (int i = 0; i < count; ++i)
    {
      const auto leaf = stride * static_cast<std::uint32_t>(2.0 * count * random());
      ASSERT_EQ(set.add(leaf), expected.insert(leaf).second) << round << ' ' << i;
    }
  }
}
