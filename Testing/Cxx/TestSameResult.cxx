// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change the result: threads, the order of extractions, a kept tree, an abort.
#include "Clouds.h"

#include "Isopoint/Extraction/NarrowBand.h"
#include "Isopoint/Extraction/SingleRank.h"
#include "Isopoint/Neighbors/AngleCriterion.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace
{

using isopoint::Isosurface;
using isopoint::IsosurfaceExtractor;

void expectSameBytes(const Isosurface& expected, const Isosurface& found)
{
  ASSERT_EQ(expected.edges.size(), found.edges.size());
  for (std::size_t i = 0; i < expected.edges.size(); ++i)
  {
    ASSERT_EQ(0, std::memcmp(&expected.edges[i], &found.edges[i], sizeof(isopoint::IsopointEdge)));
  }
  ASSERT_EQ(expected.coincident.size(), found.coincident.size());
  for (std::size_t i = 0; i < expected.coincident.size(); ++i)
  {
    EXPECT_EQ(expected.coincident[i].ids, found.coincident[i].ids);
  }
}

void expectSamePlane(const isopoint::CreasePlane& expected, const isopoint::CreasePlane& found)
{
  EXPECT_EQ(expected.inward, found.inward);
  EXPECT_EQ(expected.distance, found.distance);
  EXPECT_EQ(expected.turn, found.turn);
}

void expectSameFit(const isopoint::LocalFit& expected, const isopoint::LocalFit& found)
{
  EXPECT_EQ(expected.position, found.position);
  EXPECT_EQ(expected.gradient, found.gradient);
  EXPECT_EQ(expected.isGradientFitted, found.isGradientFitted);
  EXPECT_EQ(expected.hessian, found.hessian);
  EXPECT_EQ(expected.isSmooth, found.isSmooth);
  EXPECT_EQ(expected.spacing, found.spacing);
  EXPECT_EQ(expected.order, found.order);
  ASSERT_EQ(expected.creases.size(), found.creases.size());
  for (std::size_t i = 0; i < found.creases.size(); ++i)
  {
    expectSamePlane(expected.creases[i], found.creases[i]);
  }
}

void expectSameSplat(const isopoint::Splat& expected, const isopoint::Splat& found)
{
  EXPECT_EQ(expected.normal, found.normal);
  EXPECT_EQ(expected.radius, found.radius);
  EXPECT_EQ(expected.axis, found.axis);
  EXPECT_EQ(std::memcmp(&expected.corners, &found.corners, sizeof(expected.corners)), 0);
}

IsosurfaceExtractor loaded(const clouds::Cloud& cloud, std::size_t threads = 1)
{
  IsosurfaceExtractor extractor;
  extractor.load<float, float>(clouds::executionOn(threads), cloud.size(), clouds::readerOf(cloud));
  return extractor;
}

// Large enough for nodes that all threads split together.
constexpr std::size_t manySamples = 400000;

} // namespace

TEST(SameResult, ForAnyNumberOfThreads)
{
  for (const clouds::Cloud& cloud : { clouds::uniform(manySamples, 1),
         clouds::coincident(clouds::clustered(manySamples, 2), 0.1), clouds::lattice(70, 71, 72) })
  {
    const Isosurface expected = clouds::extract(cloud, 0.2, isopoint::defaultAngle, 1);
    EXPECT_FALSE(expected.edges.empty());
    for (const std::size_t threads : { 2, 4, 7 })
    {
      SCOPED_TRACE(threads);
      expectSameBytes(expected, clouds::extract(cloud, 0.2, isopoint::defaultAngle, threads));
    }
  }
}

// Everything that leaves the core.
TEST(SameResult, OfFitsAndSplatsForAnyNumberOfThreads)
{
  const clouds::Cloud cloud = clouds::coincident(clouds::uniform(40000, 9), 0.02);
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 0.3;
  request.splats = isopoint::SplatOptions();
  for (const isopoint::FitOrder order : { isopoint::FitOrder::Cubic, isopoint::FitOrder::Crease })
  {
    request.isosurface.fit = isopoint::FitRequest{ order, true };
    request.minimumSpacing = order == isopoint::FitOrder::Crease ? 0.5 : 0.0;
    const isopoint::ExtractedIsosurface expected =
      loaded(cloud).extract(clouds::executionOn(1), request);
    ASSERT_GT(expected.surface.size(), 1000u);
    for (const std::size_t threads : { 2, 5 })
    {
      const isopoint::ExtractedIsosurface found =
        loaded(cloud, threads).extract(clouds::executionOn(threads), request);
      expectSameBytes(expected.surface, found.surface);
      EXPECT_EQ(expected.surface.positions, found.surface.positions);
      EXPECT_EQ(expected.surface.decreasingEdges, found.surface.decreasingEdges);
      ASSERT_EQ(expected.surface.size(), found.surface.fits.size());
      ASSERT_EQ(expected.splats.size(), found.splats.size());
      for (std::size_t i = 0; i < found.splats.size(); ++i)
      {
        expectSameFit(expected.surface.fits[i], found.surface.fits[i]);
        expectSameSplat(expected.splats[i], found.splats[i]);
      }
    }
  }
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
  isopoint::ExtractionRequest request;
  request.isosurface.isovalue = 0.0;
  request.splats = isopoint::SplatOptions();
  const auto leftOf = [&](double far)
  {
    const clouds::Cloud cloud = blocks(far);
    isopoint::ExtractedIsosurface found = loaded(cloud).extract(clouds::executionOn(2), request);
    std::map<std::pair<std::uint64_t, std::uint64_t>, isopoint::Splat> splats;
    for (std::size_t i = 0; i < found.surface.size(); ++i)
    {
      const isopoint::IsopointEdge& edge = found.surface.edges[i];
      if (edge.second < count && found.surface.positions[i][0] < 5.0)
      {
        splats.emplace(std::make_pair(edge.first, edge.second), found.splats[i]);
      }
    }
    return splats;
  };
  for (const std::optional<isopoint::FitOrder> order : { std::optional<isopoint::FitOrder>(),
         std::optional(isopoint::FitOrder::Cubic), std::optional(isopoint::FitOrder::Crease) })
  {
    request.isosurface.fit = isopoint::FitRequest{ order, true };
    const auto expected = leftOf(1.0);
    const auto found = leftOf(1.5);
    ASSERT_GT(expected.size(), 500u);
    ASSERT_EQ(expected.size(), found.size());
    for (const auto& [edge, splat] : expected)
    {
      ASSERT_EQ(found.count(edge), 1u);
      expectSameSplat(splat, found.at(edge));
    }
  }
}

TEST(SameResult, ForAnyOrderOfIsovaluesAndAngles)
{
  const clouds::Cloud cloud = clouds::uniform(60000, 3);
  const isopoint::Execution execution = clouds::executionOn(2);
  IsosurfaceExtractor kept = loaded(cloud);
  std::size_t isopoints = 0;
  for (const double isovalue : { 0.5, 0.45, -1.5, 0.5, 9.0, 1.9, -1.5 })
  {
    for (const double angle : { 54.7, 20.0 })
    {
      IsosurfaceExtractor fresh = loaded(cloud);
      const Isosurface expected = clouds::extractFrom(fresh, execution, isovalue, angle);
      expectSameBytes(expected, clouds::extractFrom(kept, execution, isovalue, angle));
      isopoints += expected.edges.size();
    }
  }
  EXPECT_GT(isopoints, 1000u);
}

// Fits use representatives of large neighborhoods; these must not depend on earlier extractions.
TEST(SameResult, OfFitsInLargeNeighborhoods)
{
  const isopoint::FitRequest quadratic{ isopoint::FitOrder::Quadratic, true };
  // Fits of this order gather wider neighborhoods.
  const isopoint::FitRequest crease{ isopoint::FitOrder::Crease, true };
  for (const clouds::Cloud& cloud : { clouds::lines(6000, 3, 0, 5), clouds::curves(6000, 6) })
  {
    IsosurfaceExtractor kept = loaded(cloud);
    for (const double isovalue : { 0.3, -0.1, 0.3 })
    {
      const isopoint::FitRequest request = isovalue < 0.0 ? quadratic : crease;
      const Isosurface expected =
        clouds::extractFrom(loaded(cloud), clouds::executionOn(1), isovalue, 30.0, 0.0, request);
      const Isosurface found =
        clouds::extractFrom(kept, clouds::executionOn(3), isovalue, 30.0, 0.0, request);
      expectSameBytes(expected, found);
      ASSERT_EQ(expected.fits.size(), expected.edges.size());
      ASSERT_EQ(found.fits.size(), expected.edges.size());
      ASSERT_GT(found.fits.size(), 100u);
      for (std::size_t i = 0; i < found.fits.size(); ++i)
      {
        EXPECT_EQ(found.fits[i].position, expected.fits[i].position);
        EXPECT_EQ(found.fits[i].gradient, expected.fits[i].gradient);
        EXPECT_EQ(found.fits[i].spacing, expected.fits[i].spacing);
        EXPECT_TRUE(std::isfinite(found.fits[i].spacing));
      }
    }
  }
}

TEST(SameResult, ForNewValuesAtKeptPositions)
{
  clouds::Cloud cloud = clouds::coincident(clouds::uniform(30000, 4), 0.05);
  const isopoint::Execution execution = clouds::executionOn(2);
  IsosurfaceExtractor kept = loaded(cloud);
  clouds::extractFrom(kept, execution, 0.5, 54.7);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud.values[i] = cloud.positions[3 * i] - cloud.positions[3 * i + 1];
  }
  const auto read = clouds::readerOf(cloud);
  ASSERT_TRUE((kept.replaceValues<float, float>(execution, cloud.size(), read)));
  IsosurfaceExtractor fresh = loaded(cloud);
  const Isosurface expected = clouds::extractFrom(fresh, execution, 0.1, 54.7);
  EXPECT_FALSE(expected.edges.empty());
  expectSameBytes(expected, clouds::extractFrom(kept, execution, 0.1, 54.7));
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
  const isopoint::Execution execution;
  Isosurface expected = clouds::extractFrom(loaded(remaining), execution, 0.5, 54.7);
  EXPECT_FALSE(expected.edges.empty());
  for (isopoint::IsopointEdge& edge : expected.edges)
  {
    edge.first = ids[edge.first];
    edge.second = ids[edge.second];
  }
  expectSameBytes(expected, clouds::extractFrom(extractor, execution, 0.5, 54.7));
}

// Deeper than the 64 levels that a binary index of one machine word can represent.
TEST(SameResult, ForVeryDeepTrees)
{
  const clouds::Cloud cloud = clouds::nestedCoincident(std::size_t{ 1 } << 21);
  const isopoint::Execution execution = clouds::executionOn(2);
  auto tree =
    isopoint::loadSamples<isopoint::WideSample>(execution, cloud.size(), clouds::readerOf(cloud));
  int deepest = 0;
  isopoint::WorkProgress progress(execution);
  isopoint::SingleRank<isopoint::WideSample> rank(tree);
  for (const isopoint::BinaryIndex index :
    isopoint::NarrowBand<isopoint::WideSample>(tree, 3.5, execution, progress, 0.0).refine(rank))
  {
    deepest = std::max(deepest, isopoint::depthOf(index));
  }
  EXPECT_GT(deepest, 64);
  const Isosurface alone = clouds::extract(cloud, 3.5, 54.7, 1);
  EXPECT_FALSE(alone.edges.empty());
  expectSameBytes(alone, clouds::extract(cloud, 3.5, 54.7, 3));
}

TEST(SameResult, AfterAnAbort)
{
  const clouds::Cloud cloud = clouds::uniform(manySamples, 7);
  IsosurfaceExtractor fresh = loaded(cloud);
  const Isosurface expected = clouds::extractFrom(fresh, clouds::executionOn(1), 0.5, 54.7);
  EXPECT_FALSE(expected.edges.empty());
  for (int abortAt = 0; abortAt < 12; ++abortAt)
  {
    isopoint::Execution aborting = clouds::executionOn(2);
    int queries = 0;
    aborting.aborted = [&]() { return queries++ >= abortAt; };
    IsosurfaceExtractor extractor = loaded(cloud);
    EXPECT_THROW(clouds::extractFrom(extractor, aborting, 0.5, 54.7), isopoint::Aborted);
    expectSameBytes(expected, clouds::extractFrom(extractor, clouds::executionOn(2), 0.5, 54.7));
  }
}
