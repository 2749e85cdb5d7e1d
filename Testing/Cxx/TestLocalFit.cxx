// SPDX-License-Identifier: GPL-3.0-or-later
// Fits to the samples around an edge, for fields with known surfaces, in any units, and where no
// fit is possible. TestFitDefinition compares fits with the rule.
#include "FitTesting.h"

#include "Core/Fit/FitFrame.h"

using namespace fittesting;

namespace
{

/// Decisions of the samples next to an edge alone.
std::optional<LocalFit> fitNear(
  const std::vector<FitSample>& samples, const FitEdge& edge, FitOrder highest = FitOrder::Cubic)
{
  return LocalFitter(0.0, highest).fitNear(edge, samples);
}

double bentField(const Vector& p)
{
  return lengthOf({ p[0], p[1], p[2] + 4.0 }) - 4.1;
}

std::vector<FitSample> inUnits(std::vector<FitSample> samples, double scale, double steepness)
{
  for (FitSample& sample : samples)
  {
    sample.position = scale * sample.position;
    sample.value *= steepness;
  }
  return samples;
}

FitEdge edgeInUnits(double scale, double steepness)
{
  return { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 * scale }, 2.0 * steepness, scale };
}

} // namespace

// Of samples at one distance those that are given first.
TEST(FitFrame, EqualDistancesAreTakenInTheirOrder)
{
  std::vector<FitSample> samples;
  for (std::size_t i = 0; i < 600; ++i)
  {
    FitSample sample{ { 0.0, 0.0, 0.0 }, static_cast<double>(i) };
    sample.position[i % 3] = i % 2 == 0 ? 0.5 : -0.5;
    samples.push_back(sample);
  }
  FitFrame frame;
  frame.enter(upwards(), 0.0);
  frame.add(samples.data(), samples.data() + samples.size());
  ASSERT_EQ(frame.samples().count(), 256u);
  for (std::size_t i = 0; i < 256; ++i)
  {
    EXPECT_EQ(frame.samples().value[i], static_cast<double>(i) / 2.0);
  }
}

// Units are powers of two: no digit changes.
TEST(LocalFit, KeepsItsBitsInOtherUnits)
{
  for (const double noise : { 0.0, 0.05, 1.0 })
  {
    const std::vector<FitSample> samples = samplesOf(bentField, 80, noise);
    for (const FitOrder order : allOrders)
    {
      const LocalFit expected = fitAll(samples, upwards(), order);
      EXPECT_TRUE(expected.order);
      for (const double scale : { 0x1p-300, 0x1p-40, 2.0, 0x1p300 })
      {
        for (const double steepness : { 0x1p-300, 0x1p-20, 8.0, 0x1p300 })
        {
          const LocalFit found =
            fitAll(inUnits(samples, scale, steepness), edgeInUnits(scale, steepness), order);
          EXPECT_EQ(found.order, expected.order);
          EXPECT_EQ(found.isSmooth, expected.isSmooth);
          EXPECT_EQ(found.position, scale * expected.position);
          EXPECT_EQ(found.gradient, steepness / scale * expected.gradient);
          Hessian hessian = expected.hessian;
          std::for_each(hessian.begin(), hessian.end(),
            [&](double& derivative) { derivative *= steepness / scale / scale; });
          EXPECT_EQ(found.hessian, hessian);
        }
      }
    }
  }
}

// Denormal numbers have too few digits, and numbers at the limit of double overflow.
TEST(LocalFit, NothingIsFittedInUnitsThatAreNotNormal)
{
  const std::vector<FitSample> samples = samplesOf(bentField, 80);
  for (const auto& [scale, steepness] : { std::pair(1e-310, 1.0), std::pair(1.0, 1e-310),
         std::pair(1e308, 1.0), std::pair(1.0, 1e308), std::pair(1e-310, 1e-310) })
  {
    const FitEdge edge = edgeInUnits(scale, steepness);
    const std::vector<FitSample> others = inUnits(samples, scale, steepness);
    for (const FitOrder order : allOrders)
    {
      const std::optional<LocalFit> near = fitNear(others, edge, order);
      const LocalFit found = near ? *near : fitAll(others, edge, order);
      EXPECT_FALSE(found.order);
      EXPECT_FALSE(found.isSmooth);
      EXPECT_EQ(found.position, edge.position);
    }
  }
}

TEST(LocalFit, SamplesTooFarAwayForDoubleDoNotCount)
{
  std::vector<FitSample> samples = samplesOf(bentField, 80);
  const LocalFit expected = fitAll(samples, upwards(), FitOrder::Cubic);
  samples.insert(samples.begin() + 40, { { 1e200, 0.0, 0.0 }, 1.0 });
  const LocalFit found = fitAll(samples, upwards(), FitOrder::Cubic);
  EXPECT_EQ(found.position, expected.position);
  EXPECT_EQ(found.gradient, expected.gradient);
}

TEST(LocalFit, PointsStayWhereNoFitHolds)
{
  const Field plane = [](const Vector& p) { return p[2] + 0.1; };
  std::vector<FitSample> flat = samplesOf(plane, 30);
  for (FitSample& sample : flat)
  {
    sample.position[0] = 0.0;
  }
  for (const FitOrder order : allOrders)
  {
    for (const std::vector<FitSample>& samples :
      { samplesOf(plane, 2), samplesOf(plane, 4), flat,
        samplesOf([](const Vector&) { return 0.0; }, 30),
        samplesOf([](const Vector& p) { return -p[2]; }, 30), // decreases where the edge increases
        samplesOf([](const Vector& p) { return p[2] + 1.5; }, 30), // too far away
        samplesOf([](const Vector& p) { return 1e308 * p[2]; }, 30) })
    {
      const LocalFit found = fitAll(samples, upwards(), order);
      EXPECT_EQ(found.order, std::nullopt);
      EXPECT_FALSE(found.isSmooth);
      EXPECT_EQ(found.hessian, Hessian{});
      EXPECT_EQ(found.position, (Vector{ 0.0, 0.0, 0.0 }));
      EXPECT_TRUE(found.isGradientFitted || found.gradient == Vector({ 0.0, 0.0, 1.0 }));
    }
  }
  // The affine function of what stays for another reason is its gradient.
  const LocalFit far = fitAll(
    samplesOf([](const Vector& p) { return 3.0 * p[2] + 5.0; }, 30), upwards(), FitOrder::Cubic);
  EXPECT_TRUE(far.isGradientFitted);
  EXPECT_NEAR(far.gradient[2], 3.0, 1e-9);
}

TEST(LocalFit, SamplesNextToTheEdgeSufficeWhereTheFieldIsSmooth)
{
  const auto near = [](const Field& field, double noise, FitOrder order = FitOrder::Cubic)
  { return fitNear(samplesOf(field, 40, noise), upwards(), order); };
  const Field quadratic = [](const Vector& p) { return p[2] - 0.1 + 0.1 * p[0] * p[1]; };
  ASSERT_TRUE(near(quadratic, 0.0));
  EXPECT_EQ(near(quadratic, 0.0)->order, FitOrder::Quadratic);
  EXPECT_TRUE(near(quadratic, 0.0)->isSmooth);
  EXPECT_NEAR(near(quadratic, 0.0)->position[2], 0.1, 1e-9);
  EXPECT_TRUE(near(quadratic, 0.0, FitOrder::Crease));
  EXPECT_FALSE(near(quadratic, 0.0, FitOrder::Linear));
  EXPECT_FALSE(near(quadratic, 0.05)); // more samples are needed
  EXPECT_FALSE(near([](const Vector& p) { return std::max(p[2], p[0]) - 0.1; }, 0.0));
  // Where not even the direction is known, nor will it be.
  int stayed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const std::optional<LocalFit> noise =
      fitNear(samplesOf(quadratic, 40, 40.0, seed), upwards(), FitOrder::Cubic);
    if (noise)
    {
      EXPECT_FALSE(noise->order);
      EXPECT_EQ(noise->position, (Vector{ 0.0, 0.0, 0.0 }));
      ++stayed;
    }
  }
  EXPECT_GT(stayed, 5);
}

// A point moved by half its edge would be beyond double's range.
TEST(LocalFit, PointsAtTheLimitOfDoubleStayFinite)
{
  const double most = std::numeric_limits<double>::max();
  clouds::Random random(7);
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<FitSample> samples;
    for (int i = 0; i < 30; ++i)
    {
      const Vector p{ random() - 0.5, random() - 0.5, random() - 0.5 };
      samples.push_back({ { 0.5 * most * p[0], 0.5 * most * p[1], most * (0.6 + 0.8 * p[2]) },
        p[2] - 0.52 - 0.2 * p[0] * p[0] });
    }
    const FitEdge edge{ { 0.0, 0.0, most }, { 0.0, 0.0, 0.2 * most }, 0.2, 0.1 * most };
    const Vector found = fitAll(samples, edge, FitOrder::Cubic).position;
    ASSERT_TRUE(std::isfinite(found[0]) && std::isfinite(found[1]) && std::isfinite(found[2]));
  }
}

TEST(LocalFit, DoesNotChangeTheEdges)
{
  const clouds::Cloud cloud = clouds::uniform(20000, 3);
  const Isosurface plain = clouds::extract(cloud, 0.5, 54.7);
  const Isosurface fitted = extractFitted(cloud, 0.5, false);
  const Isosurface moved = extractFitted(cloud, 0.5, true);
  ASSERT_EQ(fitted.edges, plain.edges);
  ASSERT_EQ(moved.edges, plain.edges);
  std::size_t held = 0;
  for (std::size_t i = 0; i < plain.edges.size(); ++i)
  {
    ASSERT_EQ(fitted.edges[i].parameter, plain.edges[i].parameter);
    held += moved.fits[i].order != std::nullopt ? 1 : 0;
    const double distance = lengthOf(moved.fits[i].position - fitted.fits[i].position);
    ASSERT_TRUE(moved.fits[i].order != std::nullopt || distance == 0.0);
    ASSERT_GE(moved.edges[i].parameter, 0.0);
    ASSERT_LE(moved.edges[i].parameter, 1.0);
  }
  EXPECT_GT(held, plain.edges.size() * 9 / 10);
}
