// SPDX-License-Identifier: GPL-3.0-or-later
// Under-resolved fields (details of few samples to a wavelength), distinguished from noise and
// steps.
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

TEST(Detail, RatesIndicateWhetherItIsCommon)
{
  EXPECT_FALSE(rateOf(15, 15).isCommon());
  EXPECT_FALSE(rateOf(4, 16).isCommon());
  EXPECT_TRUE(rateOf(5, 16).isCommon());
}

TEST(Detail, FewIsopointsAreTestedWhereItIsRare)
{
  const auto countTested = [](DetectionRate rate)
  {
    int count = 0;
    for (int i = 0; i < 80; ++i)
    {
      count += rate.isWorthTesting() ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(countTested(rateOf(0, 15)), 80);
  EXPECT_EQ(countTested(rateOf(0, 16)), 10);
  EXPECT_EQ(countTested(rateOf(1, 16)), 10);
  EXPECT_EQ(countTested(rateOf(2, 16)), 80);
}

// With six samples to a wavelength residuals are as large as those of noise, but they decrease with
// the degree.
TEST(Detail, IsDistinguishedFromNoise)
{
  const double linear = meanDistanceFromGyroid(1.0, std::nullopt);
  EXPECT_LT(meanDistanceFromGyroid(1.0, FitOrder::Cubic), 0.5 * linear);
  EXPECT_LT(meanDistanceFromGyroid(1.0, FitOrder::Crease), 0.5 * linear);
}

TEST(Detail, IsNotTestedForAcrossGaps)
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
    for (const LocalFit& fitted : surface.fits)
    {
      sum += std::abs(lengthOf(fitted.position) - 12.0);
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
  for (const LocalFit& fitted : surface.fits)
  {
    moved += fitted.order != std::nullopt ? 1 : 0;
  }
  ASSERT_GT(surface.fits.size(), 2000u);
  EXPECT_LT(moved, surface.fits.size() / 50);
}

// In noise the test takes the time of several fits and detects nothing.
TEST(Detail, IsNotTestedForWhereItIsRare)
{
  const Field field = [](const Vector& p) { return std::sin(p[2]) + 0.8 * std::sin(1.2 * p[0]); };
  const auto orderAfter = [&](const DetectionRate& rate) {
    return fit(samplesOf(field, 80), upwards(), FitOrder::Cubic, 0.0, { rate, {} }).order;
  };
  EXPECT_EQ(orderAfter(rateOf(2, 16)), FitOrder::Cubic);
  EXPECT_EQ(orderAfter(rateOf(1, 16)), std::nullopt);
}

// Samples from which a curvature can be determined, but no derivative of higher order.
TEST(Detail, IsBelievedOnLessEvidenceWhereItIsCommon)
{
  const Field field = [](const Vector& p) { return p[2] + 0.2 * p[0] * p[0]; };
  const auto orderAfter = [&](const DetectionRate& rate) {
    return fit(samplesOf(field, 80, 0.5), upwards(), FitOrder::Cubic, 0.0, { rate, {} }).order;
  };
  EXPECT_EQ(orderAfter(rateOf(4, 16)), std::nullopt);
  EXPECT_EQ(orderAfter(rateOf(8, 16)), FitOrder::Cubic);
}

// Isopoints share detection rates in groups, which the ranges of threads must not divide.
TEST(Detail, DoesNotDependOnThreads)
{
  clouds::Random random(8);
  const Field field = [&](const Vector& p)
  { return lengthOf(p) + std::sin(p[0]) + 0.2 * (random() - 0.5); };
  const clouds::Cloud cloud = cloudOf(field, 15000, 24.6);
  const isopoint::Isosurface one = extractFitted(cloud, 8.0, true, 1);
  ASSERT_GT(one.fits.size(), 1000u);
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
      [order](const auto& entry) { return entry.second == order; });
  };
  EXPECT_GT(countOf(std::nullopt), 200);
  EXPECT_GT(countOf(FitOrder::Cubic), 200);
  EXPECT_TRUE(ordersOf(reversed, true) == expected);
}
