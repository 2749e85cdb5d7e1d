// SPDX-License-Identifier: GPL-3.0-or-later
// Thinning against the definition (docs/algorithm.md, section 11).
#include "ThinningTesting.h"

#include <algorithm>
#include <cstdint>
#include <limits>

using namespace thinningtesting;

namespace
{

const double minimumSpacings[] = { 1.0, 0.5, 0.1, 1e-3 };

/// Whether two points are close (docs/algorithm.md, section 11).
bool areClose(const LocalFit& a, const LocalFit& b, double minimumSpacing)
{
  const double reach = minimumSpacing * std::min(a.spacing, b.spacing);
  const double slopeA = isopoint::lengthOf(a.gradient);
  const double slopeB = isopoint::lengthOf(b.gradient);
  const Vector way = isopoint::difference(a.position, b.position);
  const Vector normalA = isopoint::directionOf(a.gradient);
  const Vector normalB = isopoint::directionOf(b.gradient);
  return a.isSmooth && b.isSmooth && slopeA > 0.0 && slopeB > 0.0 && std::isfinite(slopeA) &&
         std::isfinite(slopeB) && std::max(a.spacing, b.spacing) <= 1e290 &&
         isopoint::lengthOf(way) < reach && isopoint::dot(normalA, normalB) >= 0.906 &&
         std::abs(isopoint::dot(way, normalA)) <= 0.25 * reach &&
         std::abs(isopoint::dot(way, normalB)) <= 0.25 * reach;
}

std::vector<std::size_t> keptByDefinition(const std::vector<LocalFit>& fits, double minimumSpacing)
{
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    if (std::none_of(kept.begin(), kept.end(),
          [&](std::size_t other) { return areClose(fits[other], fits[i], minimumSpacing); }))
    {
      kept.push_back(i);
    }
  }
  return kept;
}

/// @returns the share of points that thinning with the minimum spacing 0.5 keeps
double expectTheDefinition(const Isosurface& surface)
{
  double share = 1.0;
  EXPECT_FALSE(surface.edges.empty());
  for (const double minimumSpacing : minimumSpacings)
  {
    SCOPED_TRACE(testing::Message() << "minimum spacing " << minimumSpacing);
    const std::vector<std::size_t> expected = keptByDefinition(surface.fits, minimumSpacing);
    const Isosurface found = thinned(surface, minimumSpacing);
    EXPECT_EQ(found.edges.size(), expected.size());
    EXPECT_EQ(found.fits.size(), expected.size());
    for (std::size_t i = 0; i < std::min(expected.size(), found.edges.size()); ++i)
    {
      EXPECT_EQ(found.edges[i], surface.edges[expected[i]]) << i;
      EXPECT_EQ(found.edges[i].parameter, surface.edges[expected[i]].parameter);
      EXPECT_EQ(found.positions[i], surface.positions[expected[i]]);
      EXPECT_EQ(found.decreasingEdges[i], surface.decreasingEdges[expected[i]]);
      EXPECT_EQ(found.fits[i].position, surface.fits[expected[i]].position);
      EXPECT_EQ(found.fits[i].spacing, surface.fits[expected[i]].spacing);
      if (testing::Test::HasFailure())
      {
        return share;
      }
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
std::vector<LocalFit> randomFits(std::size_t count, double side, double factor, std::uint64_t seed)
{
  clouds::Random random(seed);
  std::vector<LocalFit> fits(count);
  for (LocalFit& fit : fits)
  {
    for (double& coordinate : fit.position)
    {
      coordinate = side * (random() - 0.5);
    }
    fit.position[2] *= 0.1;
    fit.spacing = 0.2 * side * std::pow(factor, -random());
    fit.gradient = { random() - 0.5, random() - 0.5, random() < 0.5 ? -2.0 : 2.0 };
    fit.order = FitOrder::Quadratic;
    fit.isSmooth = random() >= 0.1;
  }
  return fits;
}

} // namespace

TEST(Thinning, FollowsTheDefinition)
{
  constexpr std::size_t count = 2000;
  for (const FitOrder order : { FitOrder::Quadratic, FitOrder::Cubic, FitOrder::Crease })
  {
    EXPECT_LT(expectTheDefinition(extracted(clouds::uniform(count, 62), 0.3, order)), 0.9);
    expectTheDefinition(extracted(clouds::clustered(count, 63), -4.0, order));
    expectTheDefinition(extracted(clouds::lattice(12, 13, 14), 2.0, order));
    expectTheDefinition(extracted(clouds::coarse(900, 6, 64), 4.5, order));
    expectTheDefinition(extracted(clouds::coincident(clouds::uniform(count, 65), 0.3), 0.3, order));
    expectTheDefinition(extracted(clouds::flattened(clouds::uniform(count, 66), 2), 0.4, order));
  }
  expectTheDefinition(extracted(clouds::uniform(count, 67), 0.3, FitOrder::Cubic, false));
  // Affine functions indicate no sheet.
  EXPECT_EQ(expectTheDefinition(extracted(clouds::uniform(count, 62), 0.3, FitOrder::Linear)), 1.0);
  EXPECT_TRUE(thinned(extracted(clouds::uniform(count, 67), 9.0), 1.0).edges.empty());
}

TEST(Thinning, FollowsTheDefinitionForAnySpacings)
{
  for (const double factor : { 1.0, 1e3, 1e12 })
  {
    EXPECT_LT(expectTheDefinition(surfaceOf(randomFits(3000, 1.0, factor, 68))), 1.0);
  }
}

TEST(Thinning, FollowsTheDefinitionAtAnyScale)
{
  for (const double side : { 1e-320, 1e-300, 1e-100, 1e100, 1e289, 1e292, 1e308 })
  {
    SCOPED_TRACE(side);
    expectTheDefinition(surfaceOf(randomFits(600, side, 30.0, 69)));
  }
}

// Few significant bits of the coordinates differ between points.
TEST(Thinning, FollowsTheDefinitionFarFromTheOrigin)
{
  for (const double side : { 1.0, 1e-6, 1e-10, 1e-15, 1e-18, 1e-300 })
  {
    for (const double origin : { 1024.0, -1023.9999999999999, 3.0 })
    {
      SCOPED_TRACE(testing::Message() << side << " at " << origin);
      std::vector<LocalFit> fits = randomFits(600, side, 30.0, 70);
      for (LocalFit& fit : fits)
      {
        fit.position = { fit.position[0] + origin, fit.position[1] + origin, fit.position[2] };
      }
      expectTheDefinition(surfaceOf(fits));
    }
  }
}

// Distances that equal the reach, and positions on the borders of any grid's cells.
TEST(Thinning, FollowsTheDefinitionOnALattice)
{
  std::vector<LocalFit> fits;
  for (int i = 0; i < 2000; ++i)
  {
    LocalFit fit{};
    fit.position = { (i * 7 % 20 - 10) * 0.25, (i * 11 % 21 - 10) * 0.25, (i % 5 - 2) * 0.125 };
    fit.gradient = { 0.0, 0.0, i % 3 == 0 ? -1.0 : 1.0 };
    fit.spacing = i % 4 == 0 ? 1.0 : 0.5;
    fit.order = FitOrder::Quadratic;
    fit.isSmooth = true;
    fits.push_back(fit);
  }
  EXPECT_LT(expectTheDefinition(surfaceOf(fits)), 0.9);
}

TEST(Thinning, PointsWithoutATangentPlaneAreKept)
{
  LocalFit usable{};
  usable.gradient = { 1.0, 0.0, 0.0 };
  usable.spacing = 1.0;
  usable.order = FitOrder::Cubic;
  usable.isSmooth = true;
  EXPECT_EQ(thinned(surfaceOf({ usable, usable, usable }), 0.5).edges.size(), 1u);
  const auto expectKept = [&](LocalFit fit)
  {
    EXPECT_EQ(thinned(surfaceOf({ fit, fit }), 0.5).edges.size(), 2u);
    EXPECT_EQ(thinned(surfaceOf({ fit, usable }), 0.5).edges.size(), 2u);
    EXPECT_EQ(thinned(surfaceOf({ usable, fit }), 0.5).edges.size(), 2u);
  };
  LocalFit fit = usable;
  fit.isSmooth = false;
  expectKept(fit);
  for (const double bad :
    { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    fit = usable;
    fit.gradient[1] = bad;
    expectKept(fit);
    fit = usable;
    fit.position[2] = bad;
    expectKept(fit);
    fit = usable;
    fit.spacing = bad;
    expectKept(fit);
  }
  fit = usable;
  fit.gradient = { 0.0, 0.0, 0.0 };
  expectKept(fit);
  fit = usable;
  fit.spacing = 0.0;
  expectKept(fit);
}

TEST(Thinning, DropsNothingAtZeroOrWithoutFits)
{
  Isosurface surface = surfaceOf(randomFits(1000, 1.0, 10.0, 71));
  EXPECT_EQ(thinned(surface, 0.0).edges.size(), 1000u);
  surface.fits.clear();
  EXPECT_EQ(thinned(surface, 1.0).edges.size(), 1000u);
}
