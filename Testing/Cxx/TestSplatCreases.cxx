// SPDX-License-Identifier: GPL-3.0-or-later
// Splats beside creases: clip planes, coverage, sides.
#include "SplatTesting.h"

using namespace splattesting;

namespace
{

/// By how much splats reach over creases, at a spacing of 1.
constexpr double overlap = 0.001;

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

/// Whether a place lies within a splat, seen along its normal.
/// @param step of every how many splats only one is looked at, from the first one on
bool isCovered(
  const Vector& place, const Points& points, const std::vector<Splat>& splats, std::size_t step)
{
  for (std::size_t i = 0; i < splats.size(); i += step)
  {
    const Vector offset = difference(place, points.positions[i]);
    const auto alongAxis = [&](const Vector& axis) { return dot(offset, axis) / dot(axis, axis); };
    const std::array<double, 5> clip = clipOf(splats[i]);
    if (std::hypot(alongAxis(splats[i].axis1), alongAxis(splats[i].axis2)) <= 1.0 &&
        dot({ clip[0], clip[1], clip[2] }, offset) + clip[3] >= -1e-9)
    {
      return true;
    }
  }
  return false;
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
  int clipped = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t across = i % 2 == 0 ? 0 : 2;
    const double toCrease = overlap - points.positions[i][across];
    const bool reaches = toCrease < std::hypot(splats[i].axis1[across], splats[i].axis2[across]);
    ASSERT_EQ(splats[i].clip.has_value(), reaches) << i;
    if (reaches)
    {
      ++clipped;
      std::array<double, 5> expected{ 0.0, 0.0, 0.0, toCrease, -1.0 };
      expected[across] = -1.0;
      ASSERT_EQ(clipOf(splats[i]), expected) << i;
    }
  }
  EXPECT_GT(clipped, 50);
}

// At a corner the cell is cut at both creases, and the nearer one clips.
TEST(SplatCreases, OfOnePointAreTheNearest)
{
  Points points;
  clouds::Random random(4);
  for (int i = 0; i < 500; ++i)
  {
    addFitted(points, { -3.0 * random(), -3.0 * random(), 0.0 }, isopoint::FitOrder::Crease,
      { 0.0, 0.0, -1.0 });
    const Vector& position = points.positions.back();
    std::vector<isopoint::CreasePlane>& creases = points.fits.back().creases;
    creases = { { { -1.0, 0.0, 0.0 }, -position[0], -1.0 },
      { { 0.0, -1.0, 0.0 }, -position[1], -1.0 } };
    if (creases[1].distance < creases[0].distance)
    {
      std::swap(creases[0], creases[1]);
    }
  }
  const std::vector<Splat> splats = splatsOf(points);
  int clipped = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const isopoint::CreasePlane& nearest = points.fits[i].creases[0];
    const std::size_t axis = nearest.inward[0] < 0.0 ? 0 : 1;
    const double reach = std::hypot(splats[i].axis1[axis], splats[i].axis2[axis]);
    ASSERT_EQ(splats[i].clip.has_value(), nearest.distance + overlap < reach);
    if (splats[i].clip)
    {
      EXPECT_EQ(splats[i].clip->inward, nearest.inward);
      ++clipped;
    }
    // Neither cell extends over a crease: overlaps and ellipses alone do.
    const bool isInside = points.positions[i][0] > -2.0 && points.positions[i][1] > -2.0;
    EXPECT_LT(splats[i].radius, isInside ? 1.0 : 3.0);
  }
  EXPECT_GT(clipped, 50);
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
    for (std::size_t i = 0; i < 40; ++i)
    {
      EXPECT_GT(splats[i].radius, 0.1) << i;
      const Vector inward = i % 2 == 0 ? Vector{ -1.0, 0.0, 0.0 } : Vector{ 0.0, 0.0, -1.0 };
      EXPECT_EQ(clipOf(splats[i]),
        (std::array<double, 5>{ inward[0], inward[1], inward[2], overlap, -sign }))
        << i;
    }
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
    for (std::size_t k = 0; k < 4; ++k)
    {
      ASSERT_NEAR(clipOf(turned[i])[k], clipOf(splats[i])[k], 1e-9) << i;
    }
    ASSERT_EQ(clipOf(turned[i])[4], -clipOf(splats[i])[4]) << i;
    ASSERT_NEAR(turned[i].radius, splats[i].radius, 1e-9) << i;
  }
}

// A single wrong crease fit in a plane neither clips the splats around it nor leaves a hole there.
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
  EXPECT_TRUE(std::none_of(
    splats.begin() + 1, splats.end(), [](const Splat& splat) { return splat.clip.has_value(); }));
  for (int k = 0; k < 4000; ++k)
  {
    const Vector place{ 4.0 * random() - 2.0, 4.0 * random() - 2.0, 0.0 };
    ASSERT_TRUE(isCovered(place, points, splats, 1)) << place[0] << ' ' << place[1];
  }
}
