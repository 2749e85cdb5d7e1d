// SPDX-License-Identifier: GPL-3.0-or-later
// Each fit against the rule written down plainly (docs/algorithm.md, 10.1 to 10.4): samples from
// all pairs of cells, dense least squares, refits.
#include "FitDefinition.h"
#include "FitTesting.h"
#include "RingDefinition.h"

using namespace fittesting;

namespace
{

using ringdefinition::Rings;

/// How many isopoints each step of the rule decided.
struct Steps
{
  std::size_t quadratic = 0;
  std::size_t cubic = 0;
  std::size_t rough = 0; // with the gradient of the affine function
  std::size_t stayed = 0;
};

/// @param tolerance of positions and gradients, beside edges and slopes
Steps expectTheDefinition(const clouds::Cloud& cloud, double isovalue, FitOrder highest,
  double tolerance = 1e-6, double valueError = 0.0)
{
  const Rings rings(cloud);
  const isopoint::Isosurface surface = extractFitted(cloud, isovalue, true, 1, highest, valueError);
  EXPECT_GT(surface.size(), 50u);
  Steps steps;
  for (std::size_t i = 0; i < surface.size(); ++i)
  {
    const std::size_t a = rings.cellOf(surface.edges[i].first);
    const std::size_t b = rings.cellOf(surface.edges[i].second);
    const bruteforce::Cell& low = rings.cells()[rings.cells()[a].value < isovalue ? a : b];
    const bruteforce::Cell& high = rings.cells()[rings.cells()[a].value < isovalue ? b : a];
    const Vector r = high.position - low.position;
    const double increase = high.value - low.value;
    const FitEdge edge{ low.position + (isovalue - low.value) / increase * r, r, increase,
      rings.spacing(a, b), valueError };
    const ringdefinition::Cells first = rings.firstRing(a, b);
    const ringdefinition::Cells second = rings.secondRing(a, b, isovalue);
    const ringdefinition::Cells more(
      second.begin() + static_cast<std::ptrdiff_t>(first.size()), second.end());
    const fitdefinition::Result expected =
      fitdefinition::fit(edge, isovalue, rings.samplesOf(first), rings.samplesOf(more), highest);
    const LocalFit& found = surface.fits[i];
    const double slope = lengthOf(expected.gradient);
    EXPECT_EQ(expected.order, found.order);
    EXPECT_EQ(expected.isSmooth, found.isSmooth);
    EXPECT_EQ(expected.isGradientFitted, found.isGradientFitted);
    EXPECT_EQ(edge.spacing, found.spacing);
    EXPECT_LE(lengthOf(expected.position - found.position), tolerance * lengthOf(r));
    EXPECT_LE(lengthOf(expected.gradient - found.gradient), tolerance * slope);
    for (std::size_t j = 0; j < expected.hessian.size(); ++j)
    {
      EXPECT_NEAR(expected.hessian[j], found.hessian[j], 10.0 * tolerance * slope / lengthOf(r));
    }
    steps.quadratic += found.order == FitOrder::Quadratic ? 1 : 0;
    steps.cubic += found.order == FitOrder::Cubic ? 1 : 0;
    steps.rough += found.order && !found.isSmooth ? 1 : 0;
    steps.stayed += found.order ? 0 : 1;
  }
  return steps;
}

} // namespace

TEST(FitDefinition, OnSmoothFields)
{
  const clouds::Cloud sphere = cloudOf(lengthOf, 600, 8.4);
  EXPECT_GT(expectTheDefinition(sphere, 3.0, FitOrder::Linear).rough, 100u);
  EXPECT_GT(expectTheDefinition(sphere, 3.0, FitOrder::Quadratic).quadratic, 150u);
  EXPECT_GT(expectTheDefinition(sphere, 3.0, FitOrder::Cubic).cubic, 150u);
  const clouds::Cloud waves = cloudOf(gyroid(0.6), 600, 8.4);
  EXPECT_GT(expectTheDefinition(waves, 0.3, FitOrder::Quadratic).quadratic, 150u);
  EXPECT_GT(expectTheDefinition(waves, 0.3, FitOrder::Cubic).cubic, 150u);
  // So close to a quadratic that the first ring decides almost everywhere.
  const Field plane = [](const Vector& p) { return p[2] + 0.2 * p[0] + 1e-4 * p[1] * p[2] * p[2]; };
  EXPECT_GT(expectTheDefinition(cloudOf(plane, 600, 8.4), 0.1, FitOrder::Cubic).quadratic, 90u);
}

TEST(FitDefinition, OnNoise)
{
  const auto stepsOf = [](double noise, FitOrder highest)
  {
    clouds::Random random(17);
    const auto noisy = [&](const Vector& p) { return lengthOf(p) + noise * (random() - 0.5); };
    return expectTheDefinition(cloudOf(noisy, 500, 8.0), 3.0, highest);
  };
  EXPECT_GT(stepsOf(0.02, FitOrder::Cubic).cubic, 150u);
  EXPECT_GT(stepsOf(0.2, FitOrder::Cubic).rough, 80u);
  EXPECT_GT(stepsOf(0.2, FitOrder::Quadratic).rough, 50u);
  EXPECT_GT(stepsOf(0.2, FitOrder::Linear).rough, 100u);
  EXPECT_GT(stepsOf(1.0, FitOrder::Linear).stayed, 10u);
  const Steps steps = stepsOf(1.0, FitOrder::Cubic);
  EXPECT_GT(steps.rough, 80u);
  EXPECT_GT(steps.stayed, 20u);
}

TEST(FitDefinition, OnDetailOfFewSamples)
{
  const Steps steps = expectTheDefinition(cloudOf(gyroid(1.6), 500, 8.0), 0.3, FitOrder::Cubic);
  EXPECT_GT(steps.cubic, 300u);
  EXPECT_GT(steps.quadratic, 10u); // where the cubic does not hold
  EXPECT_GT(steps.stayed, 100u);
}

TEST(FitDefinition, OnRoundedValues)
{
  const auto stepsOf = [](double step)
  {
    const auto stairs = [step](const Vector& p) { return step * std::round(lengthOf(p) / step); };
    return expectTheDefinition(
      cloudOf(stairs, 500, 8.0), 3.01, FitOrder::Cubic, 1e-6, step / std::sqrt(12.0));
  };
  EXPECT_GT(stepsOf(0.02).cubic, 150u);
  EXPECT_GT(stepsOf(0.4).rough, 80u);
  EXPECT_GT(stepsOf(1e-5).cubic, 100u);
}

TEST(FitDefinition, OnStepsAndCreases)
{
  const auto step = [](const Vector& p) { return lengthOf(p) < 3.0 ? 0.1 * p[0] : 1.0; };
  const auto cube = [](const Vector& p) {
    return std::max({ std::abs(p[0] + 0.1 * p[1]), std::abs(p[1]), std::abs(p[2]) });
  };
  const auto sheets = [](const Vector& p) { return std::abs(lengthOf(p) - 2.5); };
  expectTheDefinition(cloudOf(step, 600, 8.4), 0.5, FitOrder::Cubic);
  expectTheDefinition(cloudOf(cube, 600, 8.4), 2.5, FitOrder::Cubic);
  expectTheDefinition(cloudOf(sheets, 600, 8.4), 0.6, FitOrder::Cubic);
}

TEST(FitDefinition, OnClustersSlicesAndCoincidentSamples)
{
  const clouds::Cloud slices = clouds::withValuesOf(
    clouds::moved(clouds::uniform(500, 19), [](double* p) { p[2] = std::floor(4.0 * p[2]) / 4.0; }),
    clouds::waves);
  expectTheDefinition(clouds::clustered(500, 18), -4.0, FitOrder::Cubic);
  expectTheDefinition(slices, 0.5, FitOrder::Cubic);
  expectTheDefinition(clouds::coincident(clouds::uniform(500, 20), 0.2), 0.5, FitOrder::Cubic);
}
