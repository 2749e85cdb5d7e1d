// SPDX-License-Identifier: GPL-3.0-or-later
#include "Clouds.h"

#include "Isopoint/Splat/SplatGeometry.h"

#include <gtest/gtest.h>

namespace
{

using isopoint::cross;
using isopoint::difference;
using isopoint::dot;
using isopoint::lengthOf;
using isopoint::Splat;
using isopoint::Vector;

/// The points of a surface, one entry each.
struct Points
{
  std::vector<Vector> positions;
  std::vector<Vector> decreasingEdges;
  std::vector<isopoint::LocalFit> fits;
};

/// Samples that end at the plane x = 0.
struct HalfSpace
{
  double at(const isopoint::ExtentQuery& query) const
  {
    const double along = query.direction[0];
    return along > 0.1 ? std::min(query.enough, -query.place[0] / along) : query.enough;
  }
};

/// a, b, c, d, e as in the array SplatClip.
std::array<double, 5> clipOf(const Splat& splat)
{
  return splat.clip ? std::array<double, 5>{ splat.clip->inward[0], splat.clip->inward[1],
                        splat.clip->inward[2], splat.clip->distance, splat.clip->turn }
                    : std::array<double, 5>{};
}

template <class TExtents = HalfSpace>
std::vector<Splat> splatsOf(const Points& points, const TExtents* extents = nullptr)
{
  return isopoint::computeSplats(clouds::executionOn(2),
    { points.positions, points.decreasingEdges, points.fits }, extents, isopoint::SplatOptions());
}

std::vector<Splat> splatsOf(const std::vector<Vector>& positions, const std::vector<Vector>& edges)
{
  Points points;
  points.positions = positions;
  points.decreasingEdges = edges;
  return splatsOf(points);
}

/// Random points of the unit sphere, moved and scaled, with edges that fall outwards, askew.
struct Sphere
{
  std::vector<Vector> positions;
  std::vector<Vector> outwards;
  std::vector<Vector> edges;

  Sphere(std::size_t count, double scale, double offset)
  {
    clouds::Random random(3);
    while (this->positions.size() < count)
    {
      const Vector v{ 2.0 * random() - 1.0, 2.0 * random() - 1.0, 2.0 * random() - 1.0 };
      const double length = std::sqrt(dot(v, v));
      if (length > 0.1 && length < 1.0)
      {
        const Vector n{ v[0] / length, v[1] / length, v[2] / length };
        this->outwards.push_back(n);
        this->positions.push_back(
          { offset + scale * n[0], offset + scale * n[1], offset + scale * n[2] });
        const double askew = 1.2 * (random() - 0.5);
        this->edges.push_back(
          { scale * 0.1 * (n[0] + askew), scale * 0.1 * n[1], scale * 0.1 * (n[2] - askew) });
      }
    }
  }
};

/// A fit among samples of a spacing.
isopoint::LocalFit fitAmong(
  double spacing, std::optional<isopoint::FitOrder> order, const Vector& gradient)
{
  isopoint::LocalFit fit{};
  fit.order = order;
  fit.isGradientFitted = true;
  fit.gradient = gradient;
  fit.spacing = spacing;
  return fit;
}

/// Adds a point with a fit that held, among samples of spacing 1.
void addFitted(Points& points, const Vector& position, std::optional<isopoint::FitOrder> order,
  const Vector& gradient)
{
  points.positions.push_back(position);
  points.decreasingEdges.push_back(isopoint::scaled(-1.0, gradient));
  points.fits.push_back(fitAmong(1.0, order, gradient));
}

/// Adds a point on one of two planes that meet at the y axis at a right angle.
/// @param along the axis
/// @param off the axis, at most 0
/// @param tilt added to the fit's gradient
void addOnWedge(Points& points, bool top, double along, double off,
  isopoint::FitOrder order, const Vector& tilt)
{
  addFitted(points, top ? Vector{ off, along, 0.0 } : Vector{ 0.0, along, off }, order,
    isopoint::sum(top ? Vector{ 0.0, 0.0, -1.0 } : Vector{ -1.0, 0.0, 0.0 }, 1.0, tilt));
}

/// Turns the field to its negative.
void negate(Points& points)
{
  for (std::size_t i = 0; i < points.positions.size(); ++i)
  {
    points.fits[i].gradient = isopoint::scaled(-1.0, points.fits[i].gradient);
    points.decreasingEdges[i] = isopoint::scaled(-1.0, points.decreasingEdges[i]);
  }
}

} // namespace

TEST(Splats, NormalsOfASphereFallOutwards)
{
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    const Sphere sphere(5000, scale, scale);
    const std::vector<Splat> splats = splatsOf(sphere.positions, sphere.edges);
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      ASSERT_NEAR(dot(splats[i].normal, splats[i].normal), 1.0, 1e-12);
      ASSERT_GT(dot(splats[i].normal, sphere.outwards[i]), 0.98);
    }
  }
}

// Every place of the surface lies within the ellipse of an isopoint, seen along its normal.
TEST(Splats, EllipsesCoverTheSurface)
{
  const Sphere sphere(800, 1.0, 0.0);
  const std::vector<Vector> longEdges(sphere.edges.size(), Vector{ 0.5, 0.0, 0.0 });
  const std::vector<Splat> splats = splatsOf(sphere.positions, longEdges);
  const Sphere places(20000, 1.0, 0.0);
  for (std::size_t i = 1000; i < places.positions.size(); ++i)
  {
    bool covered = false;
    for (std::size_t k = 0; k < splats.size() && !covered; ++k)
    {
      const Vector offset = difference(places.positions[i], sphere.positions[k]);
      const double u = dot(offset, splats[k].axis1) / dot(splats[k].axis1, splats[k].axis1);
      const double v = dot(offset, splats[k].axis2) / dot(splats[k].axis2, splats[k].axis2);
      covered = dot(places.positions[i], sphere.positions[k]) > 0.0 && u * u + v * v <= 1.0;
    }
    ASSERT_TRUE(covered) << i;
  }
}

TEST(Splats, AxesSpanTheTangentPlane)
{
  const Sphere sphere(800, 1.0, 0.0);
  for (const Splat& splat : splatsOf(sphere.positions, sphere.edges))
  {
    ASSERT_NEAR(lengthOf(splat.axis1), splat.radius, 1e-12);
    ASSERT_LE(lengthOf(splat.axis2), splat.radius + 1e-12);
    ASSERT_NEAR(dot(splat.axis1, splat.axis2), 0.0, 1e-12);
    ASSERT_NEAR(dot(cross(splat.axis1, splat.axis2), splat.normal),
      lengthOf(splat.axis1) * lengthOf(splat.axis2), 1e-12);
    ASSERT_FALSE(splat.clip);
  }
}

// Rows ten times as far from each other as the points of one: the nearest all lie in one row.
TEST(Splats, RowsAreJoined)
{
  std::vector<Vector> positions;
  for (int row = 0; row < 20; ++row)
  {
    for (int i = 0; i < 200; ++i)
    {
      positions.push_back({ 0.1 * i, static_cast<double>(row), 0.0 });
    }
  }
  Points points;
  points.positions = positions;
  points.decreasingEdges.assign(positions.size(), { 0.0, 0.0, 1.0 });
  points.fits.assign(
    positions.size(), fitAmong(1.0, isopoint::FitOrder::Linear, { 0.0, 0.0, -1.0 }));
  const std::vector<Splat> splats = splatsOf(points);
  const auto& inside = splats[10 * 200 + 100];
  EXPECT_EQ(inside.normal, (Vector{ 0.0, 0.0, 1.0 }));
  EXPECT_GT(inside.radius, 0.5);
  EXPECT_LT(inside.radius, 0.7);
}

TEST(Splats, AnIsolatedPointDoesNotBecomeAPlate)
{
  Sphere sphere(800, 1.0, 0.0);
  sphere.positions.push_back({ 50.0, 0.0, 0.0 });
  sphere.edges.push_back({ 0.1, 0.0, 0.0 });
  EXPECT_LT(splatsOf(sphere.positions, sphere.edges).back().radius, 0.12);
}

// A blob no wider than the samples' spacing: its splats are hardly larger than it is.
TEST(Splats, OfASmallBlobDoNotStickOut)
{
  for (const std::size_t count : { 8, 14, 40 })
  {
    const Sphere sphere(count, 1.0, 0.0);
    Points points;
    points.positions = sphere.positions;
    points.decreasingEdges = sphere.edges;
    for (const Vector& p : sphere.positions)
    {
      points.fits.push_back(
        fitAmong(2.0, isopoint::FitOrder::Quadratic, isopoint::scaled(-1.0, p)));
      points.fits.back().hessian = { -1.0, -1.0, -1.0, 0.0, 0.0, 0.0 };
    }
    for (const Splat& splat : splatsOf(points))
    {
      EXPECT_LT(splat.radius, 1.8);
    }
  }
}

// Beside the border of a sheet cells are bounded by the points along it alone, far outside.
TEST(Splats, EndSoonOutOfTheSamples)
{
  const Vector gradient{ 0.0, 0.0, -1.0 };
  Points points;
  const HalfSpace samples;
  clouds::Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    addFitted(
      points, { -10.0 * random(), 40.0 * random(), 0.0 }, isopoint::FitOrder::Quadratic, gradient);
  }
  const std::vector<Splat> splats = splatsOf(points, &samples);
  double farthest = 0.0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    farthest = std::max(
      farthest, points.positions[i][0] + std::hypot(splats[i].axis1[0], splats[i].axis2[0]));
  }
  EXPECT_GT(farthest, 0.1);
  EXPECT_LT(farthest, 1.5);
}

// Two planes at a right angle, as fits with a crease tell of them: each splat ends at the other's,
// though a fit here and there is off.
TEST(Splats, AreClippedAtACrease)
{
  Points points;
  clouds::Random random(4);
  constexpr int count = 2000;
  const auto isOff = [](int i) { return i % 101 == 0; };
  for (int i = 0; i < count; ++i)
  {
    const bool top = i % 2 == 0;
    const double along = 10.0 * random();
    const double off = -3.0 * random();
    const double tilt = isOff(i) ? 0.1 : 0.0;
    addOnWedge(points, top, along, off, isopoint::FitOrder::Crease, { 0.0, tilt, 0.0 });
  }
  const std::vector<Splat> splats = splatsOf(points);
  int clipped = 0;
  for (int i = 0; i < count; ++i)
  {
    if (isOff(i))
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
      ASSERT_GT(toCrease, 0.3) << i; // else it would be blended with those across
    }
  }
  EXPECT_GT(clipped, 50);
}

/// Two planes at a right angle that meet at the y axis, with fits of an order on either.
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

// Also if fits on one side alone tell of the crease.
TEST(Splats, CoverAFaceUpToItsCrease)
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

// Where points of both sides are on the crease itself, those around tell which sides they are.
TEST(Splats, OfPointsOnACreaseKeepTheirSide)
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

// A field and its negative have the same surface, whose splats differ by their normals' sides.
TEST(Splats, AreAlikeWhicheverSideFalls)
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

// A point without a fit may have any normal: what lies beyond it is its fitted neighbour's to
// cover.
TEST(Splats, OfPointsBesideUnfittedOnesAreNoSmaller)
{
  const Vector gradient{ 0.0, 0.0, -1.0 };
  Points points;
  for (int i = -5; i <= 5; ++i)
  {
    for (int k = -5; k <= 5; ++k)
    {
      addFitted(points, { 1.0 * i, 1.0 * k, 0.0 }, isopoint::FitOrder::Quadratic, gradient);
    }
  }
  const std::size_t middle = points.positions.size() / 2;
  const auto axesOfMiddle = [&]()
  {
    const Splat splat = splatsOf(points)[middle];
    return std::array<double, 2>{ lengthOf(splat.axis1), lengthOf(splat.axis2) };
  };
  const std::array<double, 2> alone = axesOfMiddle();
  for (const Vector& beside : { Vector{ 0.02, 0.01, 0.0 }, Vector{ -0.3, 0.2, 0.0 },
         Vector{ -0.1, -0.3, 0.0 }, Vector{ 0.2, 0.3, 0.0 } })
  {
    addFitted(points, beside, std::nullopt, { -1.0, 0.0, -0.2 });
  }
  const std::array<double, 2> accompanied = axesOfMiddle();
  EXPECT_NEAR(accompanied[0], alone[0], 1e-12);
  EXPECT_NEAR(accompanied[1], alone[1], 1e-12);
}

// A single fit that sees a crease in a plane neither clips those around it nor makes them smaller.
TEST(Splats, AreLeftWholeByASingleFit)
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

// Samples that have the isovalue exactly put many isopoints at their own position.
TEST(Splats, PointsAtOnePositionCountOnceAmongTheNearest)
{
  const Sphere sphere(800, 1.0, 0.0);
  const std::vector<Splat> expected = splatsOf(sphere.positions, sphere.edges);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (std::size_t i = 0; i < sphere.positions.size(); ++i)
  {
    positions.insert(positions.end(), 30, sphere.positions[i]);
    edges.insert(edges.end(), 30, sphere.edges[i]);
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    ASSERT_NEAR(splats[i].radius, expected[i / 30].radius, 1e-12);
    ASSERT_GT(dot(splats[i].normal, expected[i / 30].normal), 1.0 - 1e-9);
  }
}

TEST(Splats, TooFewOrCollinearPointsTakeTheirEdge)
{
  const Vector edge{ 0.0, 2.0, 0.0 };
  for (const std::vector<Vector>& positions :
    { std::vector<Vector>{ { 1, 1, 1 } }, std::vector<Vector>{ { 1, 1, 1 }, { 1, 1, 1 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 } },
      std::vector<Vector>{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 0, 0 } } })
  {
    for (const Splat& splat : splatsOf(positions, std::vector<Vector>(positions.size(), edge)))
    {
      EXPECT_EQ(splat.normal, (Vector{ 0.0, 1.0, 0.0 }));
      EXPECT_GE(splat.radius, 1.0);
    }
  }
  EXPECT_TRUE(splatsOf({}, {}).empty());
}

// Two sheets that fall to opposite sides, closer to each other than the points of one.
TEST(Splats, SheetsCloseByKeepTheirSides)
{
  clouds::Random random(5);
  std::vector<Vector> positions;
  std::vector<Vector> edges;
  for (int i = 0; i < 4000; ++i)
  {
    const double side = i % 2 ? 1.0 : -1.0;
    positions.push_back({ random(), random(), 0.004 * side });
    edges.push_back({ 0.02 * (random() - 0.5), 0.02 * (random() - 0.5), 0.02 * side });
  }
  const std::vector<Splat> splats = splatsOf(positions, edges);
  int wrong = 0;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    wrong += dot(splats[i].normal, edges[i]) > 0.0 ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}
