// SPDX-License-Identifier: GPL-3.0-or-later
// Fits beside the edges and corners of bodies whose sides are known.
#include "FitTesting.h"

#include "Isopoint/Fit/FitNeighborhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

using namespace fittesting;

namespace
{

/// A body of several sides: where all of them are negative, or where any is. There is one sample in
/// each unit of volume, in a cube of side 46.4.
struct Body
{
  std::vector<Field> sides;
  bool isIntersection;

  double value(const Vector& p) const
  {
    double result = this->sides.front()(p);
    for (const Field& side : this->sides)
    {
      result = this->isIntersection ? std::max(result, side(p)) : std::min(result, side(p));
    }
    return result;
  }

  /// The least angle between a gradient and those of the sides that are there, in degrees.
  double degreesOff(const Vector& p, const Vector& gradient) const
  {
    constexpr double there = 0.3;
    double least = 180.0;
    for (const Field& side : this->sides)
    {
      if (std::abs(side(p) - this->value(p)) < there)
      {
        least = std::min(least, degreesBetween(gradient, slopeOf(side, p)));
      }
    }
    return least;
  }
};

/// How many isopoints of a body are far from it, and have normals far from its, in thousands of
/// all.
struct Errors
{
  double far;
  double turned;
};

Errors errorsOf(const Body& body, FitOrder highest = FitOrder::Crease)
{
  const Field field = [&](const Vector& p) { return body.value(p); };
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(field, 100000, 46.4), 0.0, true, 2, highest);
  EXPECT_GT(surface.fits.size(), 500u);
  std::size_t far = 0;
  std::size_t turned = 0;
  for (const LocalFit& at : surface.fits)
  {
    far += std::abs(field(at.position)) > 0.1 ? 1 : 0;
    turned += body.degreesOff(at.position, at.gradient) > 5.0 ? 1 : 0;
  }
  const double perThousand = 1000.0 / static_cast<double>(surface.fits.size());
  return { perThousand * static_cast<double>(far), perThousand * static_cast<double>(turned) };
}

Field ball(const Vector& center, double radius)
{
  return [=](const Vector& p) { return lengthOf(difference(p, center)) - radius; };
}

/// All within so many units of the origin, in the direction of an axis of a frame that is turned
/// against the samples' cube.
std::vector<Field> slab(std::size_t axis, double half)
{
  const std::array<Vector, 3> axes{ Vector{ 0.8, -0.6, 0.0 }, Vector{ 0.48, 0.64, -0.6 },
    Vector{ 0.36, 0.48, 0.8 } };
  const Vector direction = axes[axis];
  return { [=](const Vector& p) { return dot(p, direction) - half; },
    [=](const Vector& p) { return -dot(p, direction) - half; } };
}

Body box(double x, double y, double z)
{
  Body body{ {}, true };
  const std::array<double, 3> halves{ x, y, z };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<Field> sides = slab(axis, halves[axis]);
    body.sides.insert(body.sides.end(), sides.begin(), sides.end());
  }
  return body;
}

std::size_t countCreases(const isopoint::Isosurface& surface)
{
  return static_cast<std::size_t>(std::count_if(surface.fits.begin(), surface.fits.end(),
    [](const LocalFit& at) { return at.order == FitOrder::Crease; }));
}

/// The share of places at which residuals of random samples of a field have a pattern.
double shareOfPatterns(const Field& field, double noise)
{
  constexpr int trials = 200;
  clouds::Random random(3);
  int patterns = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    std::vector<FitSample> samples;
    while (samples.size() < 80)
    {
      const Vector p{ 6.0 * random() - 3.0, 6.0 * random() - 3.0, 6.0 * random() - 3.0 };
      if (lengthOf(p) < 3.0)
      {
        samples.push_back({ p, field(p) + noise * (random() - 0.5) });
      }
    }
    isopoint::FitNeighborhood neighborhood(upwards(), 0.0, samples, 1.2);
    patterns += neighborhood.leavesPattern() ? 1 : 0;
  }
  return static_cast<double>(patterns) / trials;
}

} // namespace

TEST(Creases, TheNearerSheetIsFound)
{
  const Field field = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const LocalFit found = fit(samplesOf(field, 80), upwards(), FitOrder::Crease);
  ASSERT_EQ(found.order, FitOrder::Crease);
  EXPECT_NEAR(field(found.position), 0.0, 1e-9);
  EXPECT_NEAR(std::max(std::abs(found.gradient[0]), std::abs(found.gradient[2])), 1.0, 1e-9);
}

TEST(Creases, ACubesPointsLieOnItsFaces)
{
  const Errors errors = errorsOf(box(12.0, 12.0, 12.0));
  EXPECT_LT(errors.far, 1.0);
  EXPECT_LT(errors.turned, 5.0);
}

// Neighbourhoods reach through it: its sides are not two functions anywhere near its rim.
TEST(Creases, AThinPlatesPointsLieOnItsFaces)
{
  const Errors errors = errorsOf(box(12.0, 12.0, 1.5));
  EXPECT_LT(errors.far, 5.0);
  EXPECT_LT(errors.turned, 50.0);
}

TEST(Creases, SidesMayBeCurved)
{
  const std::vector<Field> balls{ ball({ 7.0, 1.0, 0.5 }, 11.5), ball({ -7.0, -1.0, 0.2 }, 10.5) };
  const Field outside = [&](const Vector& p) { return -balls[1](p); };
  for (const Body& body :
    { Body{ balls, true }, Body{ balls, false }, Body{ { balls[0], outside }, true } })
  {
    const Errors errors = errorsOf(body);
    EXPECT_LT(errors.far, 4.0);
    EXPECT_LT(errors.turned, 15.0);
  }
}

// A quadratic through samples on both sides would round a curved edge off; its sides do not.
TEST(Creases, CurvedSidesKeepTheirCurvature)
{
  const Field field = [](const Vector& p)
  {
    return std::max(p[2] + 0.1 * p[0] * p[0] + 0.05 * p[1] * p[1], p[0] - 0.5 - 0.08 * p[2] * p[2]);
  };
  const LocalFit found = fit(samplesOf(field, 120), upwards(), FitOrder::Crease);
  ASSERT_EQ(found.order, FitOrder::Crease);
  EXPECT_NEAR(field(found.position), 0.0, 1e-9);
  EXPECT_NEAR(found.hessian[0], 0.2, 1e-8);
  EXPECT_NEAR(found.hessian[1], 0.1, 1e-8);
  EXPECT_NEAR(found.hessian[2], 0.0, 1e-8);
}

TEST(Creases, AreNotFoundInNoise)
{
  clouds::Random random(5);
  const Field field = [&](const Vector& p) { return lengthOf(p) - 12.0 + 0.2 * (random() - 0.5); };
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(field, 50000, 36.8), 0.0, true, 2, FitOrder::Crease);
  ASSERT_GT(surface.fits.size(), 2000u);
  EXPECT_LT(countCreases(surface), surface.fits.size() / 100);
}

// Detail that is resolved thinly leaves patterns, too.
TEST(Creases, AreRareWhereThereIsDetail)
{
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(gyroid(0.6), 20000, 27.0), 0.3, true, 2, FitOrder::Crease);
  ASSERT_GT(surface.fits.size(), 5000u);
  EXPECT_LT(countCreases(surface), surface.fits.size() / 500);
}

// Where next to none are found the search takes many times as long as the extraction.
TEST(Creases, AreNotLookedForWhereTheyAreRare)
{
  const Field field = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const auto orderAfter = [&](int found)
  {
    return fit(samplesOf(field, 80), upwards(), FitOrder::Crease, 0.0, { {}, rateOf(found, 16) })
      .order;
  };
  EXPECT_EQ(orderAfter(2), FitOrder::Crease);
  EXPECT_NE(orderAfter(1), FitOrder::Crease);
}

TEST(Creases, LeaveAPatternOfResidualsAndNoiseDoesNot)
{
  const Field wedge = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const Field bend = [](const Vector& p) { return p[2] + 0.1 * p[0] * p[0]; };
  EXPECT_GT(shareOfPatterns(wedge, 0.0), 0.95);
  EXPECT_GT(shareOfPatterns(wedge, 0.1), 0.95);
  EXPECT_LT(shareOfPatterns(bend, 0.1), 0.15);
}
