// SPDX-License-Identifier: GPL-3.0-or-later
// Fits around isopoints, against dense least squares and fields whose surfaces are known.
#include "FitDefinition.h"
#include "FitTesting.h"

#include "Isopoint/Fit/FitFrame.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

using namespace fittesting;

namespace
{

Field bentField()
{
  return [](const Vector& p) { return lengthOf({ p[0], p[1], p[2] + 4.0 }) - 4.1; };
}

std::vector<FitSample> inUnits(std::vector<FitSample> samples, double scale, double steepness)
{
  for (FitSample& sample : samples)
  {
    sample.position = scaled(scale, sample.position);
    sample.value *= steepness;
  }
  return samples;
}

FitEdge edgeInUnits(double scale, double steepness)
{
  return { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 * scale }, 2.0 * steepness, scale };
}

} // namespace

// The nearest sixteen of the first ring come first, then its others, then what the second ring
// adds; of more than 256 the nearest of the ring that exceeds this.
TEST(FitFrame, OrdersSamples)
{
  for (const auto& [firstCount, moreCount] :
    { std::pair<std::size_t, std::size_t>(5, 0), { 16, 0 }, { 17, 0 }, { 40, 60 }, { 3, 40 },
      { 256, 0 }, { 257, 0 }, { 700, 5 }, { 100, 156 }, { 100, 157 }, { 100, 600 } })
  {
    const std::vector<FitSample> samples = samplesOf(bentField(), firstCount + moreCount);
    const auto squareOf = [&](std::size_t i) {
      return dot(samples[i].position, samples[i].position) / 4.0;
    }; // the unit is the edge's length
    const auto nearestOf = [&](std::vector<std::size_t> numbers, std::size_t count)
    {
      std::sort(numbers.begin(), numbers.end(),
        [&](std::size_t a, std::size_t b) { return squareOf(a) < squareOf(b); });
      numbers.resize(std::min(numbers.size(), count));
      std::sort(numbers.begin(), numbers.end());
      return numbers;
    };
    std::vector<std::size_t> first(firstCount);
    std::iota(first.begin(), first.end(), std::size_t{ 0 });
    std::vector<std::size_t> more(moreCount);
    std::iota(more.begin(), more.end(), firstCount);
    std::vector<std::size_t> expected = nearestOf(first, 16);
    const std::vector<std::size_t> sixteen = expected;
    for (const std::size_t i : nearestOf(first, 256))
    {
      if (std::find(sixteen.begin(), sixteen.end(), i) == sixteen.end())
      {
        expected.push_back(i);
      }
    }
    const std::vector<std::size_t> added = nearestOf(more, 256 - expected.size());
    const std::vector<std::size_t> ahead =
      nearestOf(more, 16 - std::min<std::size_t>(16, expected.size()));
    expected.insert(expected.end(), ahead.begin(), ahead.end());
    std::copy_if(added.begin(), added.end(), std::back_inserter(expected),
      [&](std::size_t i) { return std::find(ahead.begin(), ahead.end(), i) == ahead.end(); });

    isopoint::FitFrame frame;
    frame.enter(upwards(), 0.0);
    ASSERT_TRUE(frame.isUsable());
    frame.add(samples.data(), samples.data() + firstCount);
    frame.add(samples.data() + firstCount, samples.data() + samples.size());
    ASSERT_EQ(frame.samples().count(), expected.size());
    double mean = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      const FitSample& sample = samples[expected[i]];
      EXPECT_EQ(isopoint::FrameSamples::at(frame.samples().x, i), sample.position[0] / 2.0);
      EXPECT_EQ(isopoint::FrameSamples::at(frame.samples().y, i), sample.position[1] / 2.0);
      EXPECT_EQ(isopoint::FrameSamples::at(frame.samples().z, i), sample.position[2] / 2.0);
      EXPECT_EQ(isopoint::FrameSamples::at(frame.samples().value, i), sample.value / 2.0);
      EXPECT_EQ(
        isopoint::FrameSamples::at(frame.samples().squaredDistance, i), squareOf(expected[i]));
      mean += std::sqrt(squareOf(expected[i])) / static_cast<double>(expected.size());
    }
    EXPECT_NEAR(frame.meanDistance(), mean, 1e-14 * mean);
  }
}

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
  isopoint::FitFrame frame;
  frame.enter(upwards(), 0.0);
  frame.add(samples.data(), samples.data() + samples.size());
  ASSERT_EQ(frame.samples().count(), 256u);
  for (std::size_t i = 0; i < 256; ++i)
  {
    EXPECT_EQ(isopoint::FrameSamples::at(frame.samples().value, i), static_cast<double>(i) / 2.0);
  }
}

TEST(LocalFit, ReproducesPolynomialsOfDegreeTwo)
{
  const Field field = [](const Vector& p)
  { return 0.1 + 0.2 * p[0] + p[2] + 0.1 * p[0] * p[0] - 0.05 * p[1] * p[2] + 0.04 * p[1] * p[1]; };
  const LocalFit found = fitAll(samplesOf(field, 30), upwards(), FitOrder::Quadratic);
  ASSERT_EQ(found.order, FitOrder::Quadratic);
  EXPECT_NEAR(field(found.position), 0.0, 1e-10);
  const Vector& p = found.position;
  EXPECT_NEAR(found.gradient[0], 0.2 + 0.2 * p[0], 1e-9);
  EXPECT_NEAR(found.gradient[1], -0.05 * p[2] + 0.08 * p[1], 1e-9);
  EXPECT_NEAR(found.gradient[2], 1.0 - 0.05 * p[1], 1e-9);
  const std::array<double, 6> hessian{ 0.2, 0.08, 0.0, 0.0, 0.0, -0.05 };
  for (std::size_t i = 0; i < hessian.size(); ++i)
  {
    EXPECT_NEAR(found.hessian[i], hessian[i], 1e-9);
  }
}

TEST(LocalFit, ReproducesPolynomialsOfDegreeThree)
{
  const Field field = [](const Vector& p)
  {
    return 0.1 + 0.2 * p[0] + p[2] + 0.1 * p[0] * p[1] + 0.03 * p[0] * p[0] * p[0] -
           0.02 * p[1] * p[1] * p[1] + 0.04 * p[2] * p[2] * p[2] +
           0.02 * (p[0] * p[0] * p[1] - p[0] * p[0] * p[2] + p[1] * p[1] * p[0]) -
           0.01 * (p[1] * p[1] * p[2] + p[2] * p[2] * p[0] - p[2] * p[2] * p[1]) +
           0.05 * p[0] * p[1] * p[2];
  };
  const std::vector<FitSample> samples = samplesOf(field, 60);
  ASSERT_EQ(fitAll(samples, upwards(), FitOrder::Quadratic).order, FitOrder::Quadratic);
  const LocalFit found = fitAll(samples, upwards(), FitOrder::Cubic);
  ASSERT_EQ(found.order, FitOrder::Cubic);
  EXPECT_NEAR(field(found.position), 0.0, 1e-9);
  const auto moved = [&](int first, double one, int second, double other)
  {
    Vector p = found.position;
    p[first] += one;
    p[second] += other;
    return field(p);
  };
  constexpr double h = 1e-3;
  const std::array<std::array<int, 2>, 6> pairs{ { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 0, 2 },
    { 1, 2 } } };
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(found.gradient[axis],
      (moved(axis, h, axis, 0.0) - moved(axis, -h, axis, 0.0)) / (2.0 * h), 1e-6);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto [a, b] = pairs[i];
    EXPECT_NEAR(found.hessian[i],
      (moved(a, h, b, h) - moved(a, h, b, -h) - moved(a, -h, b, h) + moved(a, -h, b, -h)) /
        (4.0 * h * h),
      1e-6);
  }
}

// The weighted least-squares solution by column-pivoted QR of the whole design matrix.
TEST(LocalFit, AffineFitsAgreeWithDenseLeastSquares)
{
  const Field field = [](const Vector& p) { return 0.05 + 0.3 * p[1] + p[2]; };
  const std::vector<FitSample> samples = samplesOf(field, 40, 0.2);
  const LocalFit found = fitAll(samples, upwards(), FitOrder::Linear);
  EXPECT_FALSE(found.isSmooth);
  EXPECT_EQ(found.hessian, isopoint::Hessian{});
  ASSERT_EQ(found.order, FitOrder::Linear);
  Eigen::MatrixXd design(samples.size(), 4);
  Eigen::VectorXd values(samples.size());
  double spacing = 0.0;
  for (const FitSample& sample : samples)
  {
    spacing += lengthOf(sample.position) / static_cast<double>(samples.size());
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const double distance = lengthOf(samples[i].position) / spacing;
    const double root = 1.0 / std::sqrt(1.0 + distance * distance);
    const auto row = static_cast<Eigen::Index>(i);
    design.row(row) << root, root * samples[i].position[0], root * samples[i].position[1],
      root * samples[i].position[2];
    values[row] = root * samples[i].value;
  }
  const Eigen::Vector4d expected = design.colPivHouseholderQr().solve(values);
  const Vector gradient{ expected[1], expected[2], expected[3] };
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(found.gradient[axis], gradient[axis], 1e-9);
    EXPECT_NEAR(
      found.position[axis], -expected[0] * gradient[axis] / dot(gradient, gradient), 1e-9);
  }
}

// Units are powers of two: no digit changes.
TEST(LocalFit, KeepsItsBitsInOtherUnits)
{
  for (const double noise : { 0.0, 0.05, 1.0 })
  {
    const std::vector<FitSample> samples = samplesOf(bentField(), 80, noise);
    for (const FitOrder order :
      { FitOrder::Linear, FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
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
          EXPECT_EQ(found.position, scaled(scale, expected.position));
          EXPECT_EQ(found.gradient, scaled(steepness / scale, expected.gradient));
          for (std::size_t i = 0; i < expected.hessian.size(); ++i)
          {
            EXPECT_EQ(found.hessian[i], expected.hessian[i] * (steepness / scale / scale));
          }
        }
      }
    }
  }
}

TEST(LocalFit, DoesNotDependOnUnits)
{
  const std::vector<FitSample> samples = samplesOf(bentField(), 80, 0.05);
  const LocalFit expected = fitAll(samples, upwards(), FitOrder::Cubic);
  for (const double scale : { 1e-150, 1e-20, 1e-9, 1e30, 1e150 })
  {
    for (const double steepness : { 1e-150, 1e-12, 1e25, 1e150 })
    {
      const LocalFit found =
        fitAll(inUnits(samples, scale, steepness), edgeInUnits(scale, steepness), FitOrder::Cubic);
      EXPECT_EQ(found.order, expected.order);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(found.position[axis] / scale, expected.position[axis], 1e-9);
        EXPECT_NEAR(found.gradient[axis] / steepness * scale, expected.gradient[axis], 1e-9);
      }
    }
  }
}

// Denormal numbers have too few digits, and numbers at the limit of double overflow.
TEST(LocalFit, NothingIsFittedInUnitsThatAreNotNormal)
{
  const std::vector<FitSample> samples = samplesOf(bentField(), 80);
  for (const auto& [scale, steepness] : { std::pair(1e-310, 1.0), std::pair(1.0, 1e-310),
         std::pair(1e308, 1.0), std::pair(1.0, 1e308), std::pair(1e-310, 1e-310) })
  {
    const FitEdge edge = edgeInUnits(scale, steepness);
    const std::vector<FitSample> others = inUnits(samples, scale, steepness);
    for (const FitOrder order :
      { FitOrder::Linear, FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
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
  std::vector<FitSample> samples = samplesOf(bentField(), 80);
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
  for (const FitOrder order :
    { FitOrder::Linear, FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
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
      EXPECT_EQ(found.hessian, isopoint::Hessian{});
      EXPECT_EQ(found.position, (Vector{ 0.0, 0.0, 0.0 }));
      if (!found.isGradientFitted)
      {
        EXPECT_EQ(found.gradient, (Vector{ 0.0, 0.0, 1.0 }));
      }
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

// Where values are noise, the move is a share of that to the zero (docs/algorithm.md, 10.4).
TEST(LocalFit, PointsMoveByLessWhereTheZeroIsUncertain)
{
  int accurate = 0;
  int uncertain = 0;
  for (const double noise : { 1e-3, 0.1, 0.5, 1.0 })
  {
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
      const std::vector<FitSample> samples = samplesOf(bentField(), 60, noise, seed);
      const auto taken =
        fitdefinition::takenIn(fitdefinition::Frame(upwards(), 0.0, samples), FitOrder::Cubic);
      const LocalFit found = fitAll(samples, upwards(), FitOrder::Cubic);
      ASSERT_EQ(found.order.has_value(), taken.has_value());
      if (taken)
      {
        const double share = fitdefinition::detail::shareOf(taken->move, taken->s);
        EXPECT_LE(lengthOf(difference(found.position, scaled(2.0 * share, taken->zero))), 1e-7);
        accurate += share > 0.999 ? 1 : 0;
        uncertain += share < 0.9 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(accurate, 5);
  EXPECT_GT(uncertain, 5);
}

// The gradient of an affine function is the better known one in noise.
TEST(LocalFit, TheGradientInNoiseIsTheAffineOne)
{
  const Field plane = [](const Vector& p) { return 0.1 + 0.3 * p[0] + p[2]; };
  int affine = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const std::vector<FitSample> samples = samplesOf(plane, 80, 0.5, seed);
    const LocalFit found = fitAll(samples, upwards(), FitOrder::Cubic);
    const LocalFit linear = fitAll(samples, upwards(), FitOrder::Linear);
    if (found.order && !found.isSmooth)
    {
      EXPECT_EQ(found.gradient, linear.gradient);
      EXPECT_EQ(found.hessian, isopoint::Hessian{});
      EXPECT_LT(degreesBetween(found.gradient, { 0.3, 0.0, 1.0 }), 10.0);
      ++affine;
    }
  }
  EXPECT_GT(affine, 15);
}

// Robust weights leave the samples of the isopoint's own side of a step or a crease.
TEST(LocalFit, OneSideOfAStepDecides)
{
  int exact = 0;
  int plainExact = 0;
  double sum = 0.0;
  double plainSum = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    // On the isopoint's side the surface is z = 0.2.
    const Field step = [](const Vector& p) { return p[0] > 0.7 ? 30.0 : p[2] - 0.2; };
    const std::vector<FitSample> samples = samplesOf(step, 80, 0.0, seed);
    const auto errorOf = [](const Vector& p) { return std::abs(p[2] - 0.2); };
    const fitdefinition::Frame frame(upwards(), 0.0, samples);
    const auto plain = fitdefinition::candidateOf(frame, frame.steep(), 3);
    const double error = errorOf(fitAll(samples, upwards(), FitOrder::Cubic).position);
    const double plainError = errorOf(plain ? scaled(2.0, plain->zero) : Vector{});
    exact += error < 0.01 ? 1 : 0;
    plainExact += plainError < 0.01 ? 1 : 0;
    sum += error;
    plainSum += plainError;
  }
  EXPECT_GT(exact, 6);
  EXPECT_EQ(plainExact, 0);
  EXPECT_LT(sum, plainSum);
}

TEST(LocalFit, MovesASpheresPointsOntoIt)
{
  const Field field = [](const Vector& p) { return lengthOf(p); };
  const isopoint::Isosurface surface = extractFitted(cloudOf(field, 100000, 46.4), 16.0, true);
  ASSERT_GT(surface.fits.size(), 3000u);
  for (std::size_t i = 0; i < surface.fits.size(); ++i)
  {
    const LocalFit& found = surface.fits[i];
    ASSERT_NEAR(lengthOf(found.position), 16.0, 0.005);
    ASSERT_LT(degreesBetween(found.gradient, found.position), 0.6);
  }
}

// A field whose wavelength is too short for degree two alone.
TEST(LocalFit, ErrorsDecreaseWithTheDegree)
{
  const double linear = meanDistanceFromGyroid(0.2, std::nullopt);
  const double quadratic = meanDistanceFromGyroid(0.2, FitOrder::Quadratic);
  const double cubic = meanDistanceFromGyroid(0.2, FitOrder::Cubic);
  EXPECT_LT(quadratic, 0.5 * linear);
  EXPECT_LT(cubic, 0.2 * quadratic);
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
  const isopoint::Isosurface plain = clouds::extract(cloud, 0.5, 54.7);
  const isopoint::Isosurface fitted = extractFitted(cloud, 0.5, false);
  const isopoint::Isosurface moved = extractFitted(cloud, 0.5, true);
  ASSERT_EQ(fitted.edges, plain.edges);
  ASSERT_EQ(moved.edges, plain.edges);
  std::size_t held = 0;
  for (std::size_t i = 0; i < plain.edges.size(); ++i)
  {
    ASSERT_EQ(fitted.edges[i].parameter, plain.edges[i].parameter);
    held += moved.fits[i].order != std::nullopt ? 1 : 0;
    const double distance = lengthOf(difference(moved.fits[i].position, fitted.fits[i].position));
    ASSERT_TRUE(moved.fits[i].order != std::nullopt || distance == 0.0);
    ASSERT_GE(moved.edges[i].parameter, 0.0);
    ASSERT_LE(moved.edges[i].parameter, 1.0);
  }
  EXPECT_GT(held, plain.edges.size() * 9 / 10);
}

// Neighborhoods are complete whatever was extracted before.
TEST(LocalFit, DependsNeitherOnThreadsNorOnAKeptTree)
{
  const clouds::Cloud cloud = clouds::coarse(20000, 18, 5);
  const isopoint::Isosurface expected = extractFitted(cloud, 5.0, true, 1);
  ASSERT_GT(expected.fits.size(), 1000u);
  isopoint::IsosurfaceExtractor extractor;
  const isopoint::Execution execution = clouds::executionOn(3);
  extractor.load<double, double>(execution, cloud.size(), clouds::readerOf(cloud));
  clouds::extractFrom(extractor, execution, 2.0, 54.7);
  const isopoint::Isosurface later =
    clouds::extractFrom(extractor, execution, 5.0, 54.7, 0.0, FitRequest{ FitOrder::Cubic, true });
  ASSERT_EQ(later.fits.size(), expected.fits.size());
  for (std::size_t i = 0; i < later.fits.size(); ++i)
  {
    ASSERT_EQ(later.fits[i].position, expected.fits[i].position);
    ASSERT_EQ(later.fits[i].gradient, expected.fits[i].gradient);
    ASSERT_EQ(later.fits[i].hessian, expected.fits[i].hessian);
    ASSERT_EQ(later.fits[i].order, expected.fits[i].order);
  }
}
