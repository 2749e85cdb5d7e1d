// SPDX-License-Identifier: GPL-3.0-or-later
// The oracles themselves: gradients against differences, nearest points against dense sampling.
#include "AnalyticFields.h"

#include <gtest/gtest.h>

namespace
{

using analytic::dot;
using analytic::length;
using analytic::Vector;

const std::vector<analytic::Surface> surfaces{ analytic::sphere(), analytic::torus(),
  analytic::gyroid(), analytic::marschnerLobb(), analytic::gaussianMixture(), analytic::cube(),
  analytic::twoSheets(0.08) };

} // namespace

TEST(AnalyticFields, GradientsEqualDifferencesOfValues)
{
  for (const analytic::Surface& surface : surfaces)
  {
    SCOPED_TRACE(surface.name);
    constexpr double step = 1e-6;
    clouds::Random random(1);
    for (int i = 0; i < 2000; ++i)
    {
      const Vector p = random.inCube(2.0);
      const Vector gradient = surface.gradient(p);
      Vector found;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Vector offset{};
        offset[axis] = step;
        found[axis] = (surface.value(p + offset) - surface.value(p - offset)) / (2.0 * step);
      }
      ASSERT_LT(length(found - gradient), 1e-6 * (1.0 + length(gradient)));
    }
  }
}

TEST(AnalyticFields, SurfacePointsHaveTheIsovalueAndAreTheirOwnFeet)
{
  for (const analytic::Surface& surface : surfaces)
  {
    SCOPED_TRACE(surface.name);
    for (const Vector& p : randomSurfacePoints(surface, 5000, 1.0, 3))
    {
      ASSERT_NEAR(surface.value(p), surface.isovalue, 1e-12);
      ASSERT_LT(surface.footOf(p).distance, 1e-8);
    }
  }
}

TEST(AnalyticFields, FeetLieOnTheSurfaceAndNormalsPointToDecreasingValues)
{
  for (const analytic::Surface& surface : surfaces)
  {
    SCOPED_TRACE(surface.name);
    clouds::Random random(2);
    for (int i = 0; i < 2000; ++i)
    {
      const Vector p = random.inCube(2.0);
      const analytic::Foot foot = surface.footOf(p);
      const Vector way = p - foot.point;
      ASSERT_NEAR(surface.value(foot.point), surface.isovalue, 1e-9);
      ASSERT_NEAR(foot.distance, length(way), 1e-12);
      ASSERT_FALSE(foot.normals.empty());
      Vector inwards{};
      for (const Vector& normal : foot.normals)
      {
        ASSERT_NEAR(length(normal), 1.0, 1e-12);
        inwards += normal;
      }
      const auto moved = [&](double step) { return surface.value(foot.point + step * inwards); };
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
  for (const analytic::Surface& surface : surfaces)
  {
    SCOPED_TRACE(surface.name);
    // Feet may lie outside of the cube.
    const std::vector<Vector> dense = randomSurfacePoints(surface, 30000, 1.6, 4);
    clouds::Random random(3);
    double largestExcess = 0.0;
    for (int i = 0; i < 300; ++i)
    {
      // Half of the positions anywhere, half near the surface.
      Vector p = i % 2 ? random.inCube(2.0) : dense[97 * static_cast<std::size_t>(i)];
      p += random.inCube(0.08);
      double nearest = 10.0;
      for (const Vector& q : dense)
      {
        nearest = std::min(nearest, length(p - q));
      }
      const double found = surface.footOf(p).distance;
      ASSERT_LE(found, nearest + 1e-9);
      largestExcess = std::max(largestExcess, nearest - found);
    }
    // About the distance of the points that it was compared with.
    EXPECT_LT(largestExcess, 0.08);
  }
}
