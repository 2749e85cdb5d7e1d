// SPDX-License-Identifier: GPL-3.0-or-later
// Thinning against the definition (docs/algorithm.md, section 11), and of sheets close to each
// other.
#include "Clouds.h"

#include "Core/Extraction/Thinning.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;

Isosurface thinned(Isosurface surface, double minimumSpacing)
{
  thin(Execution(), minimumSpacing, surface);
  return surface;
}

Isosurface surfaceOf(
  const clouds::Cloud& cloud, double isovalue, FitOrder order = FitOrder::Cubic, bool move = true)
{
  ExtractionRequest request = clouds::requestOf(isovalue, order);
  request.isosurface.fit->move = move;
  return clouds::extracted(cloud, request).surface;
}

/// A surface with given fits, on edges of consecutive samples.
Isosurface surfaceOf(std::vector<LocalFit> fits)
{
  Isosurface surface;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    surface.edges.push_back({ { i, i + 1 }, 0.5 });
    surface.positions.push_back(fits[i].position);
    surface.decreasingEdges.push_back({ 0.0, 0.0, 1.0 });
  }
  surface.fits = std::move(fits);
  return surface;
}

LocalFit smoothFit(const Vector& position, const Vector& gradient, double spacing)
{
  LocalFit fit{};
  fit.position = position;
  fit.gradient = gradient;
  fit.spacing = spacing;
  fit.order = FitOrder::Quadratic;
  fit.isSmooth = true;
  return fit;
}

/// Whether two points are close (docs/algorithm.md, section 11).
bool areClose(const LocalFit& a, const LocalFit& b, double minimumSpacing)
{
  const double reach = minimumSpacing * std::min(a.spacing, b.spacing);
  const double slopeA = lengthOf(a.gradient);
  const double slopeB = lengthOf(b.gradient);
  const Vector way = a.position - b.position;
  const Vector normalA = directionOf(a.gradient);
  const Vector normalB = directionOf(b.gradient);
  return a.isSmooth && b.isSmooth && slopeA > 0.0 && slopeB > 0.0 && std::isfinite(slopeA) &&
         std::isfinite(slopeB) && std::max(a.spacing, b.spacing) <= 1e290 &&
         lengthOf(way) < reach && dot(normalA, normalB) >= 0.906 &&
         std::abs(dot(way, normalA)) <= 0.25 * reach && std::abs(dot(way, normalB)) <= 0.25 * reach;
}

/// @returns the share of points that thinning with the minimum spacing 0.5 keeps
double expectTheDefinition(const Isosurface& surface)
{
  double share = 1.0;
  EXPECT_FALSE(surface.edges.empty());
  for (const double minimumSpacing : { 1.0, 0.5, 0.1, 1e-3 })
  {
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < surface.fits.size(); ++i)
    {
      const auto isClose = [&](std::size_t other)
      { return areClose(surface.fits[other], surface.fits[i], minimumSpacing); };
      if (std::none_of(expected.begin(), expected.end(), isClose))
      {
        expected.push_back(i);
      }
    }
    const Isosurface found = thinned(surface, minimumSpacing);
    EXPECT_EQ(found.edges.size(), expected.size());
    EXPECT_EQ(found.fits.size(), expected.size());
    for (std::size_t i = 0; i < expected.size() && !testing::Test::HasFailure(); ++i)
    {
      SCOPED_TRACE(testing::Message() << "minimum spacing " << minimumSpacing << ", point " << i);
      EXPECT_EQ(found.edges[i], surface.edges[expected[i]]);
      EXPECT_EQ(found.edges[i].parameter, surface.edges[expected[i]].parameter);
      EXPECT_EQ(found.positions[i], surface.positions[expected[i]]);
      EXPECT_EQ(found.decreasingEdges[i], surface.decreasingEdges[expected[i]]);
      EXPECT_EQ(found.fits[i].position, surface.fits[expected[i]].position);
      EXPECT_EQ(found.fits[i].spacing, surface.fits[expected[i]].spacing);
    }
    if (minimumSpacing == 0.5)
    {
      share = static_cast<double>(found.edges.size()) / static_cast<double>(surface.edges.size());
    }
  }
  return share;
}

/// Points in a flat box, with gradients mostly along its short axis and sample spacings that vary
/// by a factor.
std::vector<LocalFit> randomFits(
  std::size_t count, double side, double factor, std::uint64_t seed, double origin = 0.0)
{
  clouds::Random random(seed);
  std::vector<LocalFit> fits;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [x, y, z] = random.inCube(side);
    const double spacing = 0.2 * side * std::pow(factor, -random());
    fits.push_back(smoothFit({ x + origin, y + origin, 0.1 * z },
      { random() - 0.5, random() - 0.5, random() < 0.5 ? -2.0 : 2.0 }, spacing));
    fits.back().isSmooth = random() >= 0.1;
  }
  return fits;
}

/// Expects a kept point of the same sheet within the minimum spacing of each point.
/// @param isChecked(fit) whether this is expected of a point
void expectThinnedBySheets(
  const Isosurface& surface, double minimumSpacing,
  const std::function<int(const LocalFit&)>& sheetOf,
  const std::function<bool(const LocalFit&)>& isChecked = [](const LocalFit&) { return true; })
{
  const Isosurface kept = thinned(surface, minimumSpacing);
  EXPECT_LT(kept.edges.size(), surface.edges.size());
  for (const LocalFit& fit : surface.fits)
  {
    const auto isNear = [&](const LocalFit& other)
    {
      return sheetOf(other) == sheetOf(fit) &&
             lengthOf(other.position - fit.position) < minimumSpacing * fit.spacing;
    };
    ASSERT_TRUE(!isChecked(fit) || std::any_of(kept.fits.begin(), kept.fits.end(), isNear));
  }
}

} // namespace

TEST(Thinning, FollowsTheDefinition)
{
  const clouds::Cloud uniform = clouds::uniform(2000, 62);
  for (const FitOrder order : { FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
  {
    EXPECT_LT(expectTheDefinition(surfaceOf(uniform, 0.3, order)), 0.9);
    expectTheDefinition(surfaceOf(clouds::clustered(2000, 63), -4.0, order));
    expectTheDefinition(surfaceOf(clouds::lattice(12, 13, 14), 2.0, order));
    expectTheDefinition(surfaceOf(clouds::coarse(900, 6, 64), 4.5, order));
    expectTheDefinition(surfaceOf(clouds::coincident(uniform, 0.3), 0.3, order));
    expectTheDefinition(surfaceOf(clouds::flattened(uniform, 2), 0.4, order));
  }
  expectTheDefinition(surfaceOf(uniform, 0.3, FitOrder::Cubic, false));
  // Affine functions indicate no sheet.
  EXPECT_EQ(expectTheDefinition(surfaceOf(uniform, 0.3, FitOrder::Linear)), 1.0);
  EXPECT_TRUE(thinned(surfaceOf(uniform, 9.0), 1.0).edges.empty());
}

TEST(Thinning, FollowsTheDefinitionForAnySpacingsScaleAndPlace)
{
  for (const double factor : { 1.0, 1e3, 1e12 })
  {
    EXPECT_LT(expectTheDefinition(surfaceOf(randomFits(3000, 1.0, factor, 68))), 1.0);
  }
  for (const double side : { 1e-320, 1e-300, 1e-100, 1e100, 1e289, 1e292, 1e308 })
  {
    SCOPED_TRACE(side);
    expectTheDefinition(surfaceOf(randomFits(600, side, 30.0, 69)));
  }
  // Few significant bits of the coordinates differ between points.
  for (const double side : { 1.0, 1e-6, 1e-10, 1e-15, 1e-18, 1e-300 })
  {
    for (const double origin : { 1024.0, -1023.9999999999999, 3.0 })
    {
      SCOPED_TRACE(testing::Message() << side << " at " << origin);
      expectTheDefinition(surfaceOf(randomFits(600, side, 30.0, 70, origin)));
    }
  }
}

// Distances that equal the reach, and positions on the borders of any grid's cells.
TEST(Thinning, FollowsTheDefinitionOnALattice)
{
  std::vector<LocalFit> fits;
  for (int i = 0; i < 2000; ++i)
  {
    fits.push_back(
      smoothFit({ (i * 7 % 20 - 10) * 0.25, (i * 11 % 21 - 10) * 0.25, (i % 5 - 2) * 0.125 },
        { 0.0, 0.0, i % 3 == 0 ? -1.0 : 1.0 }, i % 4 == 0 ? 1.0 : 0.5));
  }
  EXPECT_LT(expectTheDefinition(surfaceOf(fits)), 0.9);
}

TEST(Thinning, PointsWithoutATangentPlaneAreKept)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const LocalFit usable = smoothFit({}, { 1.0, 0.0, 0.0 }, 1.0);
  const auto kept = [](const std::vector<LocalFit>& fits)
  { return thinned(surfaceOf(fits), 0.5).edges.size(); };
  EXPECT_EQ(kept({ usable, usable, usable }), 1u);
  std::vector<LocalFit> others{ usable, smoothFit({}, {}, 1.0),
    smoothFit({}, usable.gradient, 0.0) };
  others[0].isSmooth = false;
  for (const double bad : { infinity, nan })
  {
    others.push_back(smoothFit({}, { 1.0, bad, 0.0 }, 1.0));
    others.push_back(smoothFit({ 0.0, 0.0, bad }, usable.gradient, 1.0));
    others.push_back(smoothFit({}, usable.gradient, bad));
  }
  for (const LocalFit& fit : others)
  {
    EXPECT_EQ(kept({ fit, fit }), 2u);
    EXPECT_EQ(kept({ fit, usable }), 2u);
    EXPECT_EQ(kept({ usable, fit }), 2u);
  }
}

TEST(Thinning, DropsNothingAtZeroOrWithoutFits)
{
  Isosurface surface = surfaceOf(randomFits(1000, 1.0, 10.0, 71));
  EXPECT_EQ(thinned(surface, 0.0).edges.size(), 1000u);
  surface.fits.clear();
  EXPECT_EQ(thinned(surface, 1.0).edges.size(), 1000u);
}

// Sheets that are a third, or a tenth, of the mean sample spacing apart.
TEST(Thinning, SheetsCloseByDoNotThinEachOther)
{
  const clouds::Cloud cloud = clouds::withValuesOf(
    clouds::uniform(20000, 61), [](const Vector& p) { return (p[2] - 0.5) * (p[2] - 0.5); });
  for (const double share : { 0.33, 0.1 })
  {
    const double gap = share / std::cbrt(20000.0);
    const Isosurface two = surfaceOf(cloud, 0.25 * gap * gap);
    EXPECT_GT(two.edges.size(), 100u);
    for (const double minimumSpacing : { 1.0, 0.5 })
    {
      expectThinnedBySheets(
        two, minimumSpacing, [](const LocalFit& fit) { return fit.position[2] < 0.5; });
    }
  }
}

// The outer two have equal gradients.
TEST(Thinning, ThreeSheetsCloseByDoNotThinEachOther)
{
  constexpr double gap = 0.2;
  clouds::Random random(75);
  std::vector<LocalFit> fits;
  for (int i = 0; i < 3000; ++i)
  {
    const auto [x, y, z] = random.place();
    fits.push_back(smoothFit(
      { 10.0 * x, 10.0 * y, gap * (i % 3 + 0.2 * z) }, { 0.0, 0.0, i % 3 == 1 ? -1.0 : 1.0 }, 1.0));
  }
  for (const double minimumSpacing : { 1.0, 0.5 })
  {
    expectThinnedBySheets(surfaceOf(fits), minimumSpacing,
      [](const LocalFit& fit) { return static_cast<int>(fit.position[2] / gap); });
  }
}

// A roof whose sides meet at an angle of 140 degrees.
TEST(Thinning, SidesOfACreaseDoNotThinEachOther)
{
  const double slope = std::tan(20.0 * 3.14159265358979323846 / 180.0);
  const Isosurface roof =
    surfaceOf(clouds::withValuesOf(clouds::uniform(20000, 61),
                [slope](const Vector& p) { return p[2] - 0.5 + slope * std::abs(p[0] - 0.5); }),
      0.0, FitOrder::Crease);
  std::vector<LocalFit> sides;
  std::copy_if(roof.fits.begin(), roof.fits.end(), std::back_inserter(sides),
    [](const LocalFit& fit) { return fit.isSmooth; });
  EXPECT_LT(thinned(surfaceOf(sides), 1.0).edges.size(), sides.size() / 2);
  expectThinnedBySheets(
    surfaceOf(sides), 1.0, [](const LocalFit& fit) { return fit.gradient[0] < 0.0; },
    [](const LocalFit& fit) // points at the ridge may thin those on both sides
    { return std::abs(fit.gradient[0]) > 0.3 * lengthOf(fit.gradient); });
}
