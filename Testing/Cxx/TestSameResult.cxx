// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change the result: threads, the order of extractions, a kept tree, an abort.
#include "RankTesting.h"

#include "Core/Extraction/NarrowBand.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace
{

using isopoint::ExtractedIsosurface;
using isopoint::ExtractionRequest;
using isopoint::FitOrder;
using isopoint::IsosurfaceExtractor;

/// Compares the bytes of everything that leaves the core.
void expectSame(const ExtractedIsosurface& expected, const ExtractedIsosurface& found)
{
  EXPECT_TRUE(ranks::described(expected) == ranks::described(found));
  EXPECT_TRUE(expected.triangles == found.triangles);
}

IsosurfaceExtractor loaded(const clouds::Cloud& cloud, std::size_t threads = 1)
{
  IsosurfaceExtractor extractor;
  extractor.load<float, float>(clouds::executionOn(threads), cloud.size(), clouds::readerOf(cloud));
  return extractor;
}

/// Of points on edges.
ExtractionRequest plain(double isovalue, double angle = isopoint::defaultAngle)
{
  ExtractionRequest request;
  request.isosurface.isovalue = isovalue;
  request.isosurface.angle = angle;
  return request;
}

/// Of everything.
ExtractionRequest whole(double isovalue, FitOrder order, double minimumSpacing = 0.0)
{
  ExtractionRequest request = plain(isovalue);
  request.isosurface.fit = isopoint::FitRequest{ order, true };
  request.splats = isopoint::SplatOptions();
  request.minimumSpacing = minimumSpacing;
  return request;
}

ExtractionRequest triangles(double isovalue, bool regularizes = false)
{
  ExtractionRequest request = whole(isovalue, FitOrder::Cubic);
  request.isosurface.regularizes = regularizes;
  request.isosurface.dropsGaps = true;
  request.triangles = true;
  return request;
}

/// Extracts everything there is, on several threads and after other extractions.
void expectSameOfEverything(const clouds::Cloud& cloud)
{
  IsosurfaceExtractor kept = loaded(cloud);
  std::size_t points = 0;
  for (const ExtractionRequest& request : { whole(0.3, FitOrder::Cubic),
         whole(0.3, FitOrder::Crease, 0.5), whole(-0.1, FitOrder::Quadratic), triangles(0.3),
         triangles(0.3, true), plain(0.2, 20.0), whole(0.3, FitOrder::Cubic) })
  {
    const ExtractedIsosurface expected = loaded(cloud).extract({}, request);
    expectSame(expected, loaded(cloud, 5).extract(clouds::executionOn(5), request));
    expectSame(expected, kept.extract(clouds::executionOn(2), request));
    points += expected.surface.size();
  }
  EXPECT_GT(points, clouds::lessIfSlow(500));
}

// Large enough for nodes that all threads split together.
constexpr std::size_t manySamples = 400000;

} // namespace

TEST(SameResult, ForAnyNumberOfThreads)
{
  for (const clouds::Cloud& cloud : { clouds::uniform(manySamples, 1),
         clouds::coincident(clouds::clustered(manySamples, 2), 0.1), clouds::lattice(70, 71, 72) })
  {
    const ExtractedIsosurface expected = loaded(cloud).extract({}, plain(0.2));
    EXPECT_FALSE(expected.surface.edges.empty());
    for (const std::size_t threads : { 2, 4, 7 })
    {
      SCOPED_TRACE(threads);
      expectSame(
        expected, loaded(cloud, threads).extract(clouds::executionOn(threads), plain(0.2)));
    }
  }
}

TEST(SameResult, OfEverythingInUnevenClouds)
{
  expectSameOfEverything(clouds::coincident(clouds::uniform(clouds::lessIfSlow(10000), 9), 0.02));
  expectSameOfEverything(clouds::clustered(clouds::lessIfSlow(2000), 7));
}

// Large enough for several ranges of its points and vertices.
TEST(SameResult, OfManyPointsForAnyThreads)
{
  const clouds::Cloud cloud = clouds::uniform(70000, 8);
  for (const ExtractionRequest& request :
    { whole(0.3, FitOrder::Cubic), triangles(0.3), triangles(0.3, true) })
  {
    const ExtractedIsosurface expected = loaded(cloud).extract({}, request);
    EXPECT_GT(expected.surface.size(), 4096u);
    expectSame(expected, loaded(cloud, 3).extract(clouds::executionOn(3), request));
  }
}

TEST(SameResult, OfEverythingInALattice)
{
  expectSameOfEverything(clouds::lattice(12, 12, 12));
}

// Fits use representatives of large neighborhoods, as on lines and curves; these must not depend on
// what was extracted before.
TEST(SameResult, OfEverythingOnLines)
{
  expectSameOfEverything(clouds::lines(clouds::lessIfSlow(1500), 3, 0, 5));
}

TEST(SameResult, OfEverythingOnCurves)
{
  expectSameOfEverything(clouds::curves(clouds::lessIfSlow(1500), 6));
}

// What stands far away has no influence: the samples in the left one of two blocks have the same
// splats whatever values and positions the right one's have, as long as the plane between the
// blocks stays.
TEST(SameResult, OfSplatsWhateverStandsFarAway)
{
  constexpr std::size_t count = 20000;
  const auto blocks = [](double far)
  {
    clouds::Cloud cloud;
    clouds::Random random(3);
    for (std::size_t i = 0; i < 2 * count; ++i)
    {
      const double x = random();
      const double y = random();
      const double z = random();
      const double edge = std::max(x + 0.2 * y, z) - 0.5 + 0.3 * std::max(0.0, y - 0.5) * x;
      if (i < count)
      {
        cloud.add(10.0 * x, 10.0 * y, 10.0 * z, edge);
      }
      else if (i == count)
      {
        cloud.add(100.0, 5.0, 5.0, 0.3);
      }
      else
      {
        cloud.add(
          100.0 + 10.0 * std::pow(x, far), 10.0 * y, 10.0 * z, std::sin(far * 9.0 * x) * y - 0.1);
      }
    }
    // The corners of the bounding box.
    cloud.values[0] = cloud.values[count] = 1.0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      cloud.positions[axis] = 0.0;
      cloud.positions[3 + axis] = 10.0;
    }
    return cloud;
  };
  ExtractionRequest request = plain(0.0);
  request.splats = isopoint::SplatOptions();
  const auto leftOf = [&](double far)
  {
    const clouds::Cloud cloud = blocks(far);
    const ExtractedIsosurface found = loaded(cloud).extract(clouds::executionOn(2), request);
    std::vector<std::string> points;
    for (std::size_t i = 0; i < found.surface.size(); ++i)
    {
      if (found.surface.edges[i].second < count && found.surface.positions[i][0] < 5.0)
      {
        points.push_back(ranks::described(found, i));
      }
    }
    return points;
  };
  for (const std::optional<FitOrder> order :
    { std::optional<FitOrder>(), { FitOrder::Cubic }, { FitOrder::Crease } })
  {
    request.isosurface.fit = isopoint::FitRequest{ order, true };
    const std::vector<std::string> expected = leftOf(1.0);
    EXPECT_GT(expected.size(), 500u);
    EXPECT_TRUE(leftOf(1.5) == expected);
  }
}

TEST(SameResult, ForNewValuesAtKeptPositions)
{
  clouds::Cloud cloud = clouds::coincident(clouds::uniform(30000, 4), 0.05);
  const isopoint::Execution execution = clouds::executionOn(2);
  IsosurfaceExtractor kept = loaded(cloud);
  kept.extract(execution, plain(0.5));
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.values[i] = cloud.positions[3 * i] - cloud.positions[3 * i + 1];
  }
  const auto read = clouds::readerOf(cloud);
  ASSERT_TRUE((kept.replaceValues<float, float>(execution, cloud.size(), read)));
  const ExtractedIsosurface expected = loaded(cloud).extract(execution, plain(0.1));
  EXPECT_FALSE(expected.surface.edges.empty());
  expectSame(expected, kept.extract(execution, plain(0.1)));
}

TEST(SameResult, ValuesAreReplacedOnlyAtEqualPositions)
{
  clouds::Cloud cloud = clouds::uniform(1000, 5);
  const isopoint::Execution execution;
  IsosurfaceExtractor kept = loaded(cloud);
  cloud.positions[1500] += 0.25;
  EXPECT_FALSE(
    (kept.replaceValues<float, float>(execution, cloud.size(), clouds::readerOf(cloud))));
  cloud.positions[1500] -= 0.25;
  EXPECT_FALSE(
    (kept.replaceValues<double, float>(execution, cloud.size(), clouds::readerOf(cloud))));
  EXPECT_FALSE(
    (kept.replaceValues<float, float>(execution, cloud.size() - 1, clouds::readerOf(cloud))));
  cloud.values[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
    (kept.replaceValues<float, float>(execution, cloud.size(), clouds::readerOf(cloud))));
}

TEST(SameResult, WithSamplesLeftOut)
{
  const clouds::Cloud cloud = clouds::uniform(200000, 6);
  clouds::Cloud partlyInvalid = cloud;
  const double bad[3] = { std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  clouds::Cloud remaining;
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (i % 5 == 2)
    {
      (i % 2 ? partlyInvalid.values[i] : partlyInvalid.positions[3 * i + i % 3]) = bad[i % 3];
    }
    else
    {
      remaining.add(cloud.positions[3 * i], cloud.positions[3 * i + 1], cloud.positions[3 * i + 2],
        cloud.values[i]);
      ids.push_back(i);
    }
  }
  IsosurfaceExtractor extractor = loaded(partlyInvalid, 3);
  EXPECT_EQ(extractor.skippedCount(), cloud.size() - remaining.size());
  ExtractedIsosurface expected = loaded(remaining).extract({}, plain(0.5));
  EXPECT_FALSE(expected.surface.edges.empty());
  for (isopoint::IsopointEdge& edge : expected.surface.edges)
  {
    edge.first = ids[edge.first];
    edge.second = ids[edge.second];
  }
  expectSame(expected, extractor.extract({}, plain(0.5)));
}

// Deeper than the 64 levels that a binary index of one machine word can represent.
TEST(SameResult, ForVeryDeepTrees)
{
  const clouds::Cloud cloud = clouds::nestedCoincident(std::size_t{ 1 } << 21);
  const isopoint::Execution execution = clouds::executionOn(2);
  auto tree =
    isopoint::loadSamples<isopoint::WideSample>(execution, cloud.size(), clouds::readerOf(cloud));
  int deepest = 0;
  isopoint::SingleRank<isopoint::WideSample> rank(tree);
  for (const isopoint::BinaryIndex index :
    isopoint::NarrowBand<isopoint::WideSample>(tree, 3.5, execution).refine(rank))
  {
    deepest = std::max(deepest, isopoint::depthOf(index));
  }
  EXPECT_GT(deepest, 64);
  const ExtractedIsosurface alone = loaded(cloud).extract({}, plain(3.5));
  EXPECT_FALSE(alone.surface.edges.empty());
  expectSame(alone, loaded(cloud, 3).extract(clouds::executionOn(3), plain(3.5)));
}

TEST(SameResult, AfterAnAbortAtAnyTime)
{
  const clouds::Cloud cloud = clouds::uniform(5000, 7);
  for (const ExtractionRequest& request :
    { whole(0.5, FitOrder::Cubic, 0.5), triangles(0.5), triangles(0.5, true) })
  {
    int asked = 0;
    isopoint::Execution counting;
    counting.aborted = [&asked]() { return ++asked < 0; };
    const ExtractedIsosurface expected = loaded(cloud).extract(counting, request);
    ASSERT_GT(asked, 20);
    for (int last = 0; last < asked; last += 1 + asked / 12)
    {
      int left = last;
      isopoint::Execution aborting;
      aborting.aborted = [&left]() { return left-- <= 0; };
      IsosurfaceExtractor extractor = loaded(cloud);
      EXPECT_THROW(extractor.extract(aborting, request), isopoint::Aborted);
      expectSame(expected, extractor.extract(clouds::executionOn(2), request));
    }
  }
}
