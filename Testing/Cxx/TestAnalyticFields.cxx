// SPDX-License-Identifier: GPL-3.0-or-later
// The oracles themselves: gradients against differences, nearest points against dense sampling,
// random points of the surface against known areas.
#include "AnalyticFields.h"

#include <gtest/gtest.h>

namespace
{

using analytic::difference;
using analytic::dot;
using analytic::Foot;
using analytic::length;
using analytic::sum;
using analytic::Surface;
using analytic::Vector;

constexpr double separation = 0.08;

class Random : public clouds::Random
{
public:
  using clouds::Random::Random;

  Vector inCube(double halfSide)
  {
    const double x = (*this)() - 0.5;
    const double y = (*this)() - 0.5;
    const double z = (*this)() - 0.5;
    return { 2.0 * halfSide * x, 2.0 * halfSide * y, 2.0 * halfSide * z };
  }
};

std::vector<Vector> pointsOf(const Surface& surface, std::size_t count)
{
  return randomSurfacePoints(surface, count, 1.0, 3);
}

/// The share of a surface's random points that a condition holds for.
template <class Condition>
double share(const Surface& surface, const Condition& condition)
{
  const std::vector<Vector> points = pointsOf(surface, 40000);
  return static_cast<double>(std::count_if(points.begin(), points.end(), condition)) /
         static_cast<double>(points.size());
}

} // namespace

TEST(AnalyticFields, GradientsEqualDifferencesOfValues)
{
  constexpr double step = 1e-6;
  for (const Surface& surface : analytic::allSurfaces(0.5 * separation))
  {
    SCOPED_TRACE(surface.name);
    Random random(1);
    for (int i = 0; i < 2000; ++i)
    {
      const Vector p = random.inCube(1.0);
      const Vector gradient = surface.gradient(p);
      Vector found;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Vector ahead = p;
        Vector behind = p;
        ahead[axis] += step;
        behind[axis] -= step;
        found[axis] = (surface.value(ahead) - surface.value(behind)) / (2.0 * step);
      }
      ASSERT_LT(length(difference(found, gradient)), 1e-6 * (1.0 + length(gradient)));
    }
  }
}

TEST(AnalyticFields, SurfacePointsHaveTheIsovalueAndAreTheirOwnFeet)
{
  for (const Surface& surface : analytic::allSurfaces(0.5 * separation))
  {
    SCOPED_TRACE(surface.name);
    for (const Vector& p : pointsOf(surface, 5000))
    {
      ASSERT_NEAR(surface.value(p), surface.isovalue, 1e-12);
      ASSERT_LT(surface.footOf(p).distance, 1e-8);
    }
  }
}

TEST(AnalyticFields, FeetLieOnTheSurfaceAndNormalsPointToDecreasingValues)
{
  for (const Surface& surface : analytic::allSurfaces(0.5 * separation))
  {
    SCOPED_TRACE(surface.name);
    Random random(2);
    for (int i = 0; i < 2000; ++i)
    {
      const Vector p = random.inCube(1.0);
      const Foot foot = surface.footOf(p);
      const Vector way = difference(p, foot.point);
      ASSERT_NEAR(surface.value(foot.point), surface.isovalue, 1e-9);
      ASSERT_NEAR(foot.distance, length(way), 1e-12);
      ASSERT_FALSE(foot.normals.empty());
      Vector inwards{ 0.0, 0.0, 0.0 };
      for (const Vector& normal : foot.normals)
      {
        ASSERT_NEAR(length(normal), 1.0, 1e-12);
        inwards = sum(inwards, normal);
      }
      const auto moved = [&](double step)
      { return surface.value(sum(foot.point, analytic::scaled(inwards, step))); };
      ASSERT_LT(moved(1e-5), surface.isovalue);
      ASSERT_GT(moved(-1e-5), surface.isovalue);
      if (foot.normals.size() == 1)
      {
        // The offset is parallel to the normal: its part across is at most 1e-5, here squared.
        const double along = dot(way, foot.normals[0]);
        ASSERT_LT(foot.distance * foot.distance - along * along, 1e-10);
      }
    }
  }
}

TEST(AnalyticFields, FeetAreTheNearestPointsOfTheSurface)
{
  constexpr double beyond = 1.6; // feet may lie outside of the cube
  for (const Surface& surface : analytic::allSurfaces(0.5 * separation))
  {
    SCOPED_TRACE(surface.name);
    const std::vector<Vector> dense = randomSurfacePoints(surface, 30000, beyond, 4);
    Random random(3);
    double largestExcess = 0.0;
    for (int i = 0; i < 300; ++i)
    {
      // Half of the positions anywhere, half near the surface.
      Vector p = i % 2 ? random.inCube(1.0) : dense[97 * static_cast<std::size_t>(i)];
      p = sum(p, random.inCube(0.04));
      double nearest = 10.0;
      for (const Vector& q : dense)
      {
        nearest = std::min(nearest, length(difference(p, q)));
      }
      const double found = surface.footOf(p).distance;
      ASSERT_LE(found, nearest + 1e-9);
      largestExcess = std::max(largestExcess, nearest - found);
    }
    // About the distance of the points that it was compared with.
    EXPECT_LT(largestExcess, 0.08);
  }
}

TEST(AnalyticFields, SurfacePointsAreUniformByArea)
{
  const auto isAbove = [](const Vector& p) { return p[2] > 0.35; };
  EXPECT_NEAR(share(analytic::sphere(), isAbove), 0.25, 0.01); // by Archimedes

  // The outer half of a torus, (1 / 2 + r / (pi R)) of the whole by Pappus.
  EXPECT_NEAR(
    share(analytic::torus(), [](const Vector& p) { return std::hypot(p[0], p[1]) > 0.6; }),
    0.5 + 0.25 / (analytic::pi * 0.6), 0.01);

  const Surface cube = analytic::cube();
  const Vector middle = cube.footOf({ 0.9, 0.1, 0.1 }).normals[0];
  EXPECT_NEAR(
    share(cube, [&](const Vector& p) { return dot(cube.footOf(p).normals[0], middle) > 0.9; }),
    1.0 / 6.0, 0.01);

  const double inner = std::pow(0.65 - 0.5 * separation, 2.0);
  const double outer = std::pow(0.65 + 0.5 * separation, 2.0);
  EXPECT_NEAR(
    share(analytic::twoSheets(separation), [](const Vector& p) { return length(p) < 0.65; }),
    inner / (inner + outer), 0.01);
}
