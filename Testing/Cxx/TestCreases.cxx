// SPDX-License-Identifier: GPL-3.0-or-later
// Fits near the edges and corners of bodies whose sides are known.
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

/// A body bounded by several sides: the intersection of the half-spaces where these are negative,
/// or their union. There is one sample per unit of volume, in a cube of side 46.4.
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

  /// The least angle between a gradient and those of the sides that the place is on, in degrees.
  double angleToSides(const Vector& p, const Vector& gradient) const
  {
    constexpr double tolerance = 0.3;
    double least = 180.0;
    for (const Field& side : this->sides)
    {
      if (std::abs(side(p) - this->value(p)) < tolerance)
      {
        least = std::min(least, degreesBetween(gradient, gradientOf(side, p)));
      }
    }
    return least;
  }
};

/// The isopoints with an error of more than 0.1 in position, and of more than 5 degrees in the
/// normal, per thousand.
struct Errors
{
  double position;
  double normal;
};

Errors errorsOf(const Body& body, FitOrder highest = FitOrder::Crease)
{
  const Field field = [&](const Vector& p) { return body.value(p); };
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(field, 100000, 46.4), 0.0, true, 2, highest);
  EXPECT_GT(surface.fits.size(), 500u);
  std::size_t misplaced = 0;
  std::size_t turned = 0;
  for (const LocalFit& fit : surface.fits)
  {
    misplaced += std::abs(field(fit.position)) > 0.1 ? 1 : 0;
    turned += body.angleToSides(fit.position, fit.gradient) > 5.0 ? 1 : 0;
  }
  const double perThousand = 1000.0 / static_cast<double>(surface.fits.size());
  return { perThousand * static_cast<double>(misplaced),
    perThousand * static_cast<double>(turned) };
}

Field ball(const Vector& center, double radius)
{
  return [=](const Vector& p) { return lengthOf(difference(p, center)) - radius; };
}

/// The two sides of a slab of thickness 2 * half, normal to an axis of a frame that is rotated
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
    [](const LocalFit& fit) { return fit.order == FitOrder::Crease; }));
}

/// The share of trials with random samples of a field in which residuals are coherent.
double shareOfCoherentResiduals(const Field& field, double noise)
{
  constexpr int trials = 200;
  clouds::Random random(3);
  int coherent = 0;
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
    coherent += neighborhood.leavesPattern() ? 1 : 0;
  }
  return static_cast<double>(coherent) / trials;
}

} // namespace

TEST(Creases, TheNearestSideIsFound)
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
  EXPECT_LT(errors.position, 1.0);
  EXPECT_LT(errors.normal, 5.0);
}

// Neighbourhoods extend through the plate: near its rim they hold samples of three sides or more.
TEST(Creases, AThinPlatesPointsLieOnItsFaces)
{
  const Errors errors = errorsOf(box(12.0, 12.0, 1.5));
  EXPECT_LT(errors.position, 5.0);
  EXPECT_LT(errors.normal, 50.0);
}

TEST(Creases, SidesMayBeCurved)
{
  const std::vector<Field> balls{ ball({ 7.0, 1.0, 0.5 }, 11.5), ball({ -7.0, -1.0, 0.2 }, 10.5) };
  const Field outside = [&](const Vector& p) { return -balls[1](p); };
  for (const Body& body :
    { Body{ balls, true }, Body{ balls, false }, Body{ { balls[0], outside }, true } })
  {
    const Errors errors = errorsOf(body);
    EXPECT_LT(errors.position, 4.0);
    EXPECT_LT(errors.normal, 15.0);
  }
}

// A single quadratic through samples of both sides would round a curved edge off.
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

TEST(Creases, AreNotDetectedInNoise)
{
  clouds::Random random(5);
  const Field field = [&](const Vector& p) { return lengthOf(p) - 12.0 + 0.2 * (random() - 0.5); };
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(field, 50000, 36.8), 0.0, true, 2, FitOrder::Crease);
  ASSERT_GT(surface.fits.size(), 2000u);
  EXPECT_LT(countCreases(surface), surface.fits.size() / 100);
}

// Residuals of an under-resolved field are coherent, too.
TEST(Creases, AreRarelyDetectedInAnUnderResolvedField)
{
  const isopoint::Isosurface surface =
    extractFitted(cloudOf(gyroid(0.6), 20000, 27.0), 0.3, true, 2, FitOrder::Crease);
  ASSERT_GT(surface.fits.size(), 5000u);
  EXPECT_LT(countCreases(surface), surface.fits.size() / 500);
}

// Where next to none are detected, testing everywhere would take many times as long as the
// extraction.
TEST(Creases, AreNotTestedForWhereTheyAreRare)
{
  const Field field = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const auto orderAfter = [&](int detected)
  {
    return fit(samplesOf(field, 80), upwards(), FitOrder::Crease, 0.0, { {}, rateOf(detected, 16) })
      .order;
  };
  EXPECT_EQ(orderAfter(2), FitOrder::Crease);
  EXPECT_NE(orderAfter(1), FitOrder::Crease);
}

TEST(Creases, LeaveCoherentResidualsAndNoiseDoesNot)
{
  const Field wedge = [](const Vector& p) { return std::max(p[2], p[0]) - 0.1; };
  const Field bend = [](const Vector& p) { return p[2] + 0.1 * p[0] * p[0]; };
  EXPECT_GT(shareOfCoherentResiduals(wedge, 0.0), 0.95);
  EXPECT_GT(shareOfCoherentResiduals(wedge, 0.1), 0.95);
  EXPECT_LT(shareOfCoherentResiduals(bend, 0.1), 0.15);
}
