// SPDX-License-Identifier: GPL-3.0-or-later
// Splats beside creases: clip planes, coverage, sides.
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

} // namespace

// Two planes at a right angle with crease fits on both, a few of which are wrong: each splat ends
// at the other plane.
TEST(SplatCreases, EndAtTheOtherSide)
{
  Points points;
  clouds::Random random(4);
  constexpr int count = 2000;
  const auto isWrong = [](int i) { return i % 101 == 0; };
  for (int i = 0; i < count; ++i)
  {
    const bool top = i % 2 == 0;
    const double along = 10.0 * random();
    const double off = -3.0 * random();
    const double tilt = isWrong(i) ? 0.1 : 0.0;
    addOnWedge(points, top, along, off, isopoint::FitOrder::Crease, { 0.0, tilt, 0.0 });
  }
  const std::vector<Splat> splats = splatsOf(points);
  int clipped = 0;
  for (int i = 0; i < count; ++i)
  {
    if (isWrong(i))
    {
      continue;
    }
    const bool top = i % 2 == 0;
    const double toCrease = -(top ? points.positions[i][0] : points.positions[i][2]);
    const std::array<double, 5> expected =
      top ? std::array<double, 5>{ -1.0, 0.0, 0.0, toCrease, -1.0 }
          : std::array<double, 5>{ 0.0, 0.0, -1.0, toCrease, -1.0 };
    if (splats[i].clip)
    {
      ++clipped;
      for (int k = 0; k < 5; ++k)
      {
        ASSERT_NEAR(clipOf(splats[i])[k], expected[k], 1e-12);
      }
    }
    else
    {
      const std::size_t across = top ? 0 : 2;
      ASSERT_GT(toCrease, std::hypot(splats[i].axis1[across], splats[i].axis2[across])) << i;
      ASSERT_GT(toCrease, 0.3) << i; // unclipped splats must not blend with those across
    }
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
    const auto isCoveredBy = [&](const Vector& place, std::size_t i)
    {
      const Vector offset = difference(place, points.positions[i]);
      const auto alongAxis = [&](const Vector& axis)
      { return dot(offset, axis) / dot(axis, axis); };
      const std::array<double, 5> clip = clipOf(splats[i]);
      return std::hypot(alongAxis(splats[i].axis1), alongAxis(splats[i].axis2)) <= 1.0 &&
             dot({ clip[0], clip[1], clip[2] }, offset) + clip[3] >= -1e-9;
    };
    clouds::Random random(8);
    for (int k = 0; k < 4000; ++k)
    {
      const Vector place{ -0.5 * random(), 1.0 + 8.0 * random(), 0.0 };
      bool isCovered = false;
      for (std::size_t i = 0; i < splats.size() && !isCovered; i += 2)
      {
        isCovered = isCoveredBy(place, i);
      }
      ASSERT_TRUE(isCovered) << place[0] << ' ' << place[1];
    }
  }
}

// For points on the crease itself, the points around determine the side that their splats cover.
TEST(SplatCreases, OfPointsOnACreaseCoverTheirOwnSide)
{
  for (const double sign : { 1.0, -1.0 })
  {
    Points points = wedge(isopoint::FitOrder::Crease, isopoint::FitOrder::Crease);
    for (std::size_t i = 0; i < 40; ++i)
    {
      points.positions[i] = { 0.0, 0.25 * static_cast<double>(i), 0.0 };
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
      EXPECT_EQ(
        clipOf(splats[i]), (std::array<double, 5>{ inward[0], inward[1], inward[2], 0.0, -sign }))
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

// A single wrong crease fit in a plane neither clips the splats around it nor makes them smaller.
TEST(SplatCreases, AreNotClippedByASingleFit)
{
  const auto splatsAround = [](const Vector& gradient)
  {
    Points points;
    clouds::Random random(4);
    addFitted(points, { 0.0, 0.0, 0.0 }, isopoint::FitOrder::Crease, gradient);
    for (int i = 1; i < 500; ++i)
    {
      addFitted(points, { 10.0 * random() - 5.0, 10.0 * random() - 5.0, 0.0 },
        isopoint::FitOrder::Quadratic, { 0.0, 0.0, -1.0 });
    }
    return splatsOf(points);
  };
  const std::vector<Splat> splats = splatsAround({ -1.0, 0.0, -1.0 });
  const std::vector<Splat> expected = splatsAround({ 0.0, 0.0, -1.0 });
  for (std::size_t i = 1; i < splats.size(); ++i)
  {
    ASSERT_FALSE(splats[i].clip) << i;
    ASSERT_GE(splats[i].radius, expected[i].radius - 1e-12) << i;
  }
}
