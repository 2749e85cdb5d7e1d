// SPDX-License-Identifier: GPL-3.0-or-later
// Distances from surfaces that are known exactly: fits are far better than linear interpolation on
// smooth fields, and on average never worse elsewhere.
#include "AnalyticFields.h"
#include "FitTesting.h"

using namespace fittesting;

namespace
{

constexpr std::size_t sampleCount = 6000;
const double spacing = 2.0 / std::cbrt(static_cast<double>(sampleCount));

/// The distances of slices and lines of samples along x, y and z, in spacings; 0: anywhere.
using Sampling = Vector;
constexpr Sampling anywhere{ 0.0, 0.0, 0.0 };

/// @param noise its standard deviation over that of the field
clouds::Cloud sampled(
  const analytic::Surface& surface, const Sampling& sampling, double noise, std::uint64_t seed)
{
  clouds::Random random(seed);
  clouds::Cloud cloud;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < sampleCount; ++i)
  {
    Vector p = random.inCube(2.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double step = sampling[axis] * spacing;
      p[axis] = step > 0.0 ? step * (std::floor(p[axis] / step) + 0.5) : p[axis];
    }
    const double value = surface.value(p);
    sum += value / sampleCount;
    squares += value * value / sampleCount;
    cloud.add(p, value);
  }
  const double amplitude = noise * std::sqrt(squares - sum * sum);
  for (double& value : cloud.values)
  {
    double normal = -6.0; // nearly, as a sum of twelve uniform numbers
    for (int i = 0; i < 12; ++i)
    {
      normal += random();
    }
    value += amplitude * normal;
  }
  return cloud;
}

/// A surface `factor` times smaller: more of it in the cube if above 1.
analytic::Surface zoomed(const analytic::Surface& surface, double factor)
{
  analytic::Surface result = surface;
  result.value = [=](const analytic::Vector& p) { return surface.value(factor * p); };
  result.footOf = [=](const analytic::Vector& p)
  {
    analytic::Foot foot = surface.footOf(factor * p);
    foot.distance /= factor;
    return foot;
  };
  return result;
}

/// The mean distance of isopoints two spacings inside the samples.
/// @param moved for which points: those that linear interpolation puts there
double meanDistance(const analytic::Surface& surface, const isopoint::Isosurface& linear,
  const isopoint::Isosurface& moved)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < linear.size(); ++i)
  {
    const Vector& p = linear.positions[i];
    if (std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) < 1.0 - 2.0 * spacing)
    {
      sum += surface.footOf(moved.positions[i]).distance;
      count += 1.0;
    }
  }
  EXPECT_GT(count, 200.0);
  return sum / count;
}

/// The mean distance with fits over that by linear interpolation, the largest of five seeds.
double largestRatio(const analytic::Surface& surface, const Sampling& sampling = anywhere,
  double noise = 0.0, FitOrder order = FitOrder::Cubic)
{
  double largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const clouds::Cloud cloud = sampled(surface, sampling, noise, seed);
    const auto linear = extractFitted(cloud, surface.isovalue, false, 2, FitOrder::Linear);
    const auto moved = extractFitted(cloud, surface.isovalue, true, 2, order);
    largest = std::max(
      largest, meanDistance(surface, linear, moved) / meanDistance(surface, linear, linear));
  }
  return largest;
}

} // namespace

TEST(FitAccuracy, SmoothFields)
{
  EXPECT_LT(largestRatio(analytic::sphere()), 0.03);
  EXPECT_LT(largestRatio(analytic::gyroid()), 0.08);
  EXPECT_LT(largestRatio(analytic::torus()), 0.2);
  EXPECT_LT(largestRatio(analytic::gaussianMixture()), 0.3);
}

TEST(FitAccuracy, NeverWorseInNoise)
{
  for (const double noise : { 0.01, 0.05 })
  {
    EXPECT_LT(largestRatio(analytic::sphere(), anywhere, noise), 1.0);
    EXPECT_LT(largestRatio(analytic::torus(), anywhere, noise), 1.0);
    EXPECT_LT(largestRatio(analytic::gyroid(), anywhere, noise), 1.0);
  }
}

TEST(FitAccuracy, NeverWorseAtStepsAndCreases)
{
  analytic::Surface step = analytic::sphere();
  step.name = "step";
  step.value = [](const analytic::Vector& p) { return analytic::length(p) < 0.7 ? 0.0 : 1.4; };
  for (const FitOrder order : { FitOrder::Cubic, FitOrder::Crease })
  {
    EXPECT_LT(largestRatio(step, anywhere, 0.0, order), 1.0);
    EXPECT_LT(largestRatio(analytic::cube(), anywhere, 0.0, order), 1.0);
    EXPECT_LT(largestRatio(analytic::twoSheets(2.0 * spacing), anywhere, 0.0, order), 1.0);
  }
}

TEST(FitAccuracy, NeverWorseOnSlicesOrLines)
{
  EXPECT_LT(largestRatio(analytic::sphere(), { 0.0, 0.0, 2.0 }), 1.0);
  EXPECT_LT(largestRatio(analytic::sphere(), { 0.0, 0.0, 4.0 }), 1.0);
  EXPECT_LT(largestRatio(analytic::sphere(), { 4.0, 4.0, 0.0 }), 1.0);
  EXPECT_LT(largestRatio(analytic::sphere(), { 0.0, 0.0, 2.0 }, 0.01), 1.0);
}

// Ripples of three to five samples: residuals are as large as those of noise.
TEST(FitAccuracy, DetailOfFewSamples)
{
  EXPECT_LT(largestRatio(zoomed(analytic::gyroid(), 4.0)), 0.8);
  EXPECT_LT(largestRatio(zoomed(analytic::marschnerLobb(), 0.3)), 0.3);
}
