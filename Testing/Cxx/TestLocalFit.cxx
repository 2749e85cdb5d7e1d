// SPDX-License-Identifier: GPL-3.0-or-later
// Fits around isopoints, against dense least squares and fields whose surfaces are known.
#include "FitTesting.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>

using namespace fittesting;

TEST(LocalFit, ReproducesPolynomialsOfDegreeTwo)
{
  const Field field = [](const Vector& p)
  { return 0.1 + 0.2 * p[0] + p[2] + 0.1 * p[0] * p[0] - 0.05 * p[1] * p[2] + 0.04 * p[1] * p[1]; };
  const LocalFit found = fit(samplesOf(field, 30), upwards(), FitOrder::Quadratic);
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
  ASSERT_NE(fit(samples, upwards(), FitOrder::Quadratic).order, FitOrder::Cubic);
  const LocalFit found = fit(samples, upwards(), FitOrder::Cubic);
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
  const LocalFit found = fit(samples, upwards(), FitOrder::Linear);
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

TEST(LocalFit, DoesNotDependOnUnits)
{
  const Field field = [](const Vector& p) { return lengthOf({ p[0], p[1], p[2] + 8.0 }) - 8.1; };
  const std::vector<FitSample> samples = samplesOf(field, 30);
  const LocalFit expected = fit(samples, upwards(), FitOrder::Quadratic);
  ASSERT_EQ(expected.order, FitOrder::Quadratic);
  for (const double scale : { 1e-20, 1e-9, 1e30 })
  {
    for (const double slope : { 1e-12, 1e25 })
    {
      std::vector<FitSample> others = samples;
      for (FitSample& sample : others)
      {
        sample.position = scaled(scale, sample.position);
        sample.value *= slope;
      }
      const FitEdge edge{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 2.0 * scale }, 2.0 * slope, scale };
      const LocalFit found = fit(others, edge, FitOrder::Quadratic);
      EXPECT_EQ(found.order, FitOrder::Quadratic);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(found.position[axis] / scale, expected.position[axis], 1e-9);
        EXPECT_NEAR(found.gradient[axis] / slope * scale, expected.gradient[axis], 1e-9);
      }
    }
  }
}

TEST(LocalFit, PointsStayWhereNoFitHolds)
{
  const Field plane = [](const Vector& p) { return p[2] + 0.1; };
  const Field step = [](const Vector& p) { return p[2] < 0.1 ? -1.0 : 1.0; };
  std::vector<FitSample> flat = samplesOf(plane, 30);
  for (FitSample& sample : flat)
  {
    sample.position[0] = 0.0;
  }
  for (const std::vector<FitSample>& samples :
    { samplesOf(plane, 2), samplesOf(plane, 4), flat, samplesOf(step, 30),
      samplesOf(plane, 30, 4.0), samplesOf([](const Vector&) { return 0.0; }, 30),
      samplesOf([](const Vector& p) { return -p[2]; }, 30), // decreases where the edge increases
      samplesOf([](const Vector& p) { return p[2] + 1.5; }, 30), // too far away
      samplesOf([](const Vector& p) { return 1e308 * p[2]; }, 30) })
  {
    const LocalFit found = fit(samples, upwards(), FitOrder::Quadratic);
    EXPECT_EQ(found.order, std::nullopt);
    EXPECT_EQ(found.position, (Vector{ 0.0, 0.0, 0.0 }));
    if (!found.isGradientFitted)
    {
      EXPECT_EQ(found.gradient, (Vector{ 0.0, 0.0, 1.0 }));
    }
  }
}

// Gathering a wider neighbourhood costs ten times as much as a fit.
TEST(LocalFit, WiderNeighborhoodsAreGatheredOnlyWhereTheyMayImproveTheFit)
{
  const auto isWiderGathered = [](FitOrder highest, const Field& field, double noise)
  {
    bool isGathered = false;
    const std::vector<FitSample> samples = samplesOf(field, 30, noise);
    isopoint::DetectionRates rates;
    isopoint::fitAround(
      upwards(), 0.0, samples,
      [&]() -> const std::vector<FitSample>&
      {
        isGathered = true;
        return samples;
      },
      highest, rates);
    return isGathered;
  };
  const Field plane = [](const Vector& p) { return p[2]; };
  EXPECT_FALSE(isWiderGathered(FitOrder::Crease, plane, 0.0));
  EXPECT_FALSE(isWiderGathered(FitOrder::Quadratic, plane, 10.0));
  const Field wedge = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const Field fold = [](const Vector& p) { return std::abs(p[2] + 0.5) - 0.5; };
  EXPECT_TRUE(isWiderGathered(FitOrder::Crease, wedge, 0.0));
  EXPECT_TRUE(isWiderGathered(FitOrder::Crease, fold, 0.0));
  EXPECT_TRUE(isWiderGathered(FitOrder::Cubic, fold, 0.0));
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
    const Vector found = fit(samples, edge, FitOrder::Cubic).position;
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

// Neighbourhoods are complete whatever was extracted before.
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
