// SPDX-License-Identifier: GPL-3.0-or-later
// Detail that samples resolve thinly, told from noise and from steps.
#include "FitTesting.h"

#include "Isopoint/Fit/DetectionRate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

using namespace fittesting;
using isopoint::DetectionRate;

TEST(Detail, TalliesTellWhetherItIsCommon)
{
  EXPECT_FALSE(rateOf(15, 15).isCommon());
  EXPECT_FALSE(rateOf(4, 16).isCommon());
  EXPECT_TRUE(rateOf(5, 16).isCommon());
}

TEST(Detail, FewAreAskedWhereItIsRare)
{
  const auto asked = [](DetectionRate tally)
  {
    int count = 0;
    for (int i = 0; i < 80; ++i)
    {
      count += tally.isWorthTesting() ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(asked(rateOf(0, 15)), 80);
  EXPECT_EQ(asked(rateOf(0, 16)), 10);
  EXPECT_EQ(asked(rateOf(1, 16)), 10);
  EXPECT_EQ(asked(rateOf(2, 16)), 80);
}

// Residuals are as large as those of noise here, six samples to a wave; but they fall with the
// degree.
TEST(Detail, IsToldFromNoiseWhereItIsThinlySampled)
{
  const double linear = meanDistanceFromGyroid(1.0, std::nullopt);
  EXPECT_LT(meanDistanceFromGyroid(1.0, FitOrder::Cubic), 0.5 * linear);
  EXPECT_LT(meanDistanceFromGyroid(1.0, FitOrder::Crease), 0.5 * linear);
}

TEST(Detail, IsNotLookedForAcrossGaps)
{
  const Field field = [](const Vector& p) { return std::sin(p[2]) + 0.8 * std::sin(1.2 * p[0]); };
  FitEdge edge = upwards();
  EXPECT_EQ(fit(samplesOf(field, 80), edge, FitOrder::Cubic).order, FitOrder::Cubic);
  edge.spacing = 0.1;
  EXPECT_EQ(fit(samplesOf(field, 80), edge, FitOrder::Cubic).order, std::nullopt);
}

TEST(Detail, StepsAreNotMadeWorse)
{
  const auto meanDistance = [](std::optional<FitOrder> highest)
  {
    const Field field = [](const Vector& p) { return lengthOf(p) < 12.0 ? 0.0 : 1.0; };
    const isopoint::Isosurface surface =
      extractFitted(cloudOf(field, 50000, 36.8), 0.5, true, 2, highest);
    double sum = 0.0;
    for (const LocalFit& at : surface.fits)
    {
      sum += std::abs(lengthOf(at.position) - 12.0);
    }
    return sum / static_cast<double>(surface.fits.size());
  };
  EXPECT_LT(meanDistance(FitOrder::Cubic), meanDistance(std::nullopt));
}

TEST(Detail, NoiseMovesFewPoints)
{
  clouds::Random random(5);
  const Field field = [&](const Vector& p) { return lengthOf(p) + 0.5 * (random() - 0.5); };
  const isopoint::Isosurface surface = extractFitted(cloudOf(field, 50000, 36.8), 12.0, true);
  std::size_t moved = 0;
  for (const LocalFit& at : surface.fits)
  {
    moved += at.order != std::nullopt ? 1 : 0;
  }
  ASSERT_GT(surface.fits.size(), 2000u);
  EXPECT_LT(moved, surface.fits.size() / 50);
}

// In noise it takes the time of several fits to no avail.
TEST(Detail, IsNotLookedForWhereItIsRare)
{
  const Field field = [](const Vector& p) { return std::sin(p[2]) + 0.8 * std::sin(1.2 * p[0]); };
  const auto orderAfter = [&](const DetectionRate& rate) {
    return fit(samplesOf(field, 80), upwards(), FitOrder::Cubic, 0.0, { rate, {} }).order;
  };
  EXPECT_EQ(orderAfter(rateOf(2, 16)), FitOrder::Cubic);
  EXPECT_EQ(orderAfter(rateOf(1, 16)), std::nullopt);
}

// Samples that tell of a bend, but not of more.
TEST(Detail, IsBelievedOnLessEvidenceWhereItIsCommon)
{
  const Field field = [](const Vector& p) { return p[2] + 0.2 * p[0] * p[0]; };
  const auto orderAfter = [&](const DetectionRate& rate) {
    return fit(samplesOf(field, 80, 0.5), upwards(), FitOrder::Cubic, 0.0, { rate, {} }).order;
  };
  EXPECT_EQ(orderAfter(rateOf(4, 16)), std::nullopt);
  EXPECT_EQ(orderAfter(rateOf(8, 16)), FitOrder::Cubic);
}

// Isopoints share rates; ranges of threads must not cut these.
TEST(Detail, DoesNotDependOnThreads)
{
  clouds::Random random(8);
  const Field field = [&](const Vector& p)
  { return lengthOf(p) + std::sin(p[0]) + 0.2 * (random() - 0.5); };
  const clouds::Cloud cloud = cloudOf(field, 15000, 24.6);
  const isopoint::Isosurface one = extractFitted(cloud, 8.0, true, 1);
  for (const std::size_t threads : { 2, 3 })
  {
    const isopoint::Isosurface several = extractFitted(cloud, 8.0, true, threads);
    ASSERT_EQ(one.fits.size(), several.fits.size());
    for (std::size_t i = 0; i < one.fits.size(); ++i)
    {
      ASSERT_EQ(one.fits[i].order, several.fits[i].order);
      ASSERT_EQ(one.fits[i].position, several.fits[i].position);
    }
  }
}

TEST(Detail, DoesNotDependOnTheOrderOfSamples)
{
  clouds::Random random(9);
  const Field field = [&](const Vector& p)
  { return lengthOf(p) + std::sin(p[0]) + (p[1] > 0.0 ? 0.4 : 0.0) * (random() - 0.5); };
  const clouds::Cloud cloud = cloudOf(field, 15000, 24.6);
  clouds::Cloud reversed;
  for (std::size_t i = cloud.size(); i-- > 0;)
  {
    reversed.add(cloud.positions[3 * i], cloud.positions[3 * i + 1], cloud.positions[3 * i + 2],
      cloud.values[i]);
  }
  using Ends = std::pair<std::uint64_t, std::uint64_t>;
  const auto ordersOf = [](const clouds::Cloud& samples, bool isReversed)
  {
    const isopoint::Isosurface surface = extractFitted(samples, 8.0, true);
    std::map<Ends, std::optional<FitOrder>> orders;
    for (std::size_t i = 0; i < surface.edges.size(); ++i)
    {
      const Ends ends{ surface.edges[i].first, surface.edges[i].second };
      const std::uint64_t last = samples.size() - 1;
      orders[isReversed ? Ends{ last - ends.second, last - ends.first } : ends] =
        surface.fits[i].order;
    }
    return orders;
  };
  const std::map<Ends, std::optional<FitOrder>> expected = ordersOf(cloud, false);
  const auto countOf = [&expected](std::optional<FitOrder> order)
  {
    return std::count_if(expected.begin(), expected.end(),
      [order](const auto& point) { return point.second == order; });
  };
  EXPECT_GT(countOf(std::nullopt), 200);
  EXPECT_GT(countOf(FitOrder::Cubic), 200);
  EXPECT_TRUE(ordersOf(reversed, true) == expected);
}
