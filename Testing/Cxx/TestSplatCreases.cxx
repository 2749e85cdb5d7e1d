// SPDX-License-Identifier: GPL-3.0-or-later
// Splats beside creases: where they end, coverage, sides.
#include "SplatTesting.h"

using namespace splattesting;

namespace
{

/// Two planes that meet at the y axis at a right angle, with fits of one order on each.
Points wedge(isopoint::FitOrder topOrder, isopoint::FitOrder sideOrder)
{
  Points points;
  clouds::Random random(7);
  for (int i = 0; i < 800; ++i)
  {
    const bool top = i % 2 == 0;
    const double along = 10.0 * random();
    const double off = -4.0 * random();
    addOnWedge(points, top, along, off, top ? topOrder : sideOrder, { 0.0, 0.0, 0.0 });
  }
  return points;
}

/// Whether a place lies within one of the splats, seen along its normal.
/// @param step of every how many splats only one is looked at, from the first one on
bool isCovered(
  const Vector& place, const Points& points, const std::vector<Splat>& splats, std::size_t step)
{
  for (std::size_t i = 0; i < splats.size(); i += step)
  {
    if (isWithin(splats[i], difference(place, points.positions[i])))
    {
      return true;
    }
  }
  return false;
}

/// How far the corners of a splat reach along an axis.
double reachAlong(const Splat& splat, std::size_t axis)
{
  double farthest = -1e9;
  for (const isopoint::SplatCorner& corner : cornersOf(splat))
  {
    farthest = std::max(farthest, offsetOf(splat, corner)[axis]);
  }
  return farthest;
}

} // namespace

// Two planes at a right angle with crease fits on both: each splat that reaches the other plane
// ends there.
TEST(SplatCreases, EndAtTheOtherSide)
{
  Points points;
  clouds::Random random(4);
  constexpr std::size_t count = 2000;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double along = 10.0 * random();
    const double off = -3.0 * random();
    addOnWedge(points, i % 2 == 0, along, off, isopoint::FitOrder::Crease, { 0.0, 0.0, 0.0 });
  }
  const std::vector<Splat> splats = splatsOf(points);
  int ending = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t across = i % 2 == 0 ? 0 : 2;
    const double beyond = points.positions[i][across] + reachAlong(splats[i], across);
    ASSERT_LT(beyond, 1e-6) << i;
    ending += beyond > -1e-6 ? 1 : 0;
  }
  EXPECT_GT(ending, 50);
}

// At a corner the splat ends at both creases.
TEST(SplatCreases, OfOnePointAllCount)
{
  Points points;
  clouds::Random random(4);
  for (int i = 0; i < 500; ++i)
  {
    addFitted(points, { -3.0 * random(), -3.0 * random(), 0.0 }, isopoint::FitOrder::Crease,
      { 0.0, 0.0, -1.0 });
    const Vector& position = points.positions.back();
    points.fits.back().creases = { { { -1.0, 0.0, 0.0 }, -position[0], -1.0 },
      { { 0.0, -1.0, 0.0 }, -position[1], -1.0 } };
  }
  const std::vector<Splat> splats = splatsOf(points);
  int ending = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    for (const std::size_t axis : { 0, 1 })
    {
      const double beyond = points.positions[i][axis] + reachAlong(splats[i], axis);
      ASSERT_LT(beyond, 1e-6);
      ending += beyond > -1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(ending, 40);
}

// Also if there are crease fits on one side only.
TEST(SplatCreases, CoverAFaceUpToItsCrease)
{
  using isopoint::FitOrder;
  for (const FitOrder order : { FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
  {
    const Points points = wedge(order, FitOrder::Crease);
    const std::vector<Splat> splats = splatsOf(points);
    clouds::Random random(8);
    for (int k = 0; k < 4000; ++k)
    {
      const Vector place{ -0.5 * random(), 1.0 + 8.0 * random(), 0.0 };
      ASSERT_TRUE(isCovered(place, points, splats, 2)) << place[0] << ' ' << place[1];
    }
  }
}

// Points on the crease itself.
TEST(SplatCreases, OfPointsOnACreaseCoverTheirOwnSide)
{
  for (const double sign : { 1.0, -1.0 })
  {
    Points points = wedge(isopoint::FitOrder::Crease, isopoint::FitOrder::Crease);
    for (std::size_t i = 0; i < 40; ++i)
    {
      points.positions[i] = { 0.0, 0.25 * static_cast<double>(i), 0.0 };
      points.fits[i].creases[0].distance = 0.0;
    }
    if (sign < 0.0)
    {
      negate(points);
    }
    const std::vector<Splat> splats = splatsOf(points);
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < 40; ++i)
    {
      if (splats[i].radius == 0.0)
      {
        ++hidden; // behind a point close by
        continue;
      }
      EXPECT_GT(splats[i].radius, 0.1) << i;
      EXPECT_NEAR(reachAlong(splats[i], i % 2 == 0 ? 0 : 2), 0.0, 1e-6) << i;
    }
    EXPECT_LE(hidden, 2u);
  }
}

// A field and its negative have the same surface; only the directions of normals differ.
TEST(SplatCreases, OfTheNegatedFieldHaveTheSameShape)
{
  Points points;
  clouds::Random random(6);
  for (int i = 0; i < 2000; ++i)
  {
    const bool top = i % 2 == 0;
    const double along = 10.0 * random();
    const double off = -3.0 * random();
    const double tilt = 0.05 * (random() - 0.5);
    addOnWedge(points, top, along, off, isopoint::FitOrder::Crease,
      top ? Vector{ tilt, 0.0, 0.0 } : Vector{ 0.0, 0.0, tilt });
  }
  const std::vector<Splat> splats = splatsOf(points);
  negate(points);
  const std::vector<Splat> turned = splatsOf(points);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    ASSERT_EQ(turned[i].normal, isopoint::scaled(-1.0, splats[i].normal));
    ASSERT_NEAR(turned[i].radius, splats[i].radius, 1e-9) << i;
    ASSERT_NEAR(areaOf(turned[i]), areaOf(splats[i]), 1e-6) << i;
  }
}

// A single wrong crease fit in a plane leaves no hole there.
TEST(SplatCreases, OfASingleWrongFitHarmNoOthers)
{
  Points points;
  clouds::Random random(4);
  addFitted(points, { 0.0, 0.0, 0.0 }, isopoint::FitOrder::Crease, { -1.0, 0.0, -1.0 });
  points.fits[0].creases = { { { 0.0, 0.0, -1.0 }, 0.0, -1.0 } };
  for (int i = 1; i < 500; ++i)
  {
    addFitted(points, { 10.0 * random() - 5.0, 10.0 * random() - 5.0, 0.0 },
      isopoint::FitOrder::Quadratic, { 0.0, 0.0, -1.0 });
  }
  const std::vector<Splat> splats = splatsOf(points);
  for (int k = 0; k < 4000; ++k)
  {
    const Vector place{ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 0.0 };
    ASSERT_TRUE(isCovered(place, points, splats, 1)) << place[0] << ' ' << place[1];
  }
}
