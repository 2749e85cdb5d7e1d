// SPDX-License-Identifier: GPL-3.0-or-later
// Thinning: against the definition, and on sheets and creases of known shape.
#include "Clouds.h"

#include "Isopoint/Neighbors/AngleCriterion.h"
#include "Isopoint/Extraction/Thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

namespace
{

using isopoint::FitOrder;
using isopoint::FitRequest;
using isopoint::Isosurface;
using isopoint::LocalFit;
using isopoint::Vector;

const double spacings[] = { 1.0, 0.5, 0.1, 1e-3 };

/// The definition, as plainly as can be.
bool areClose(const LocalFit& a, const LocalFit& b, double minimumSpacing)
{
  const double reach = minimumSpacing * std::min(a.spacing, b.spacing);
  const double slopeA = isopoint::lengthOf(a.gradient);
  const double slopeB = isopoint::lengthOf(b.gradient);
  const Vector way = isopoint::difference(a.position, b.position);
  const Vector normalA = isopoint::directionOf(a.gradient);
  const Vector normalB = isopoint::directionOf(b.gradient);
  return a.order != std::nullopt && b.order != std::nullopt && slopeA > 0.0 && slopeB > 0.0 &&
         std::isfinite(slopeA) && std::isfinite(slopeB) &&
         std::max(a.spacing, b.spacing) <= 1e290 && isopoint::lengthOf(way) < reach &&
         isopoint::dot(normalA, normalB) >= 0.906 &&
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

Isosurface thinned(Isosurface surface, double minimumSpacing)
{
  isopoint::thin(isopoint::Execution(), minimumSpacing, surface);
  return surface;
}

/// Compares bytes, for numbers that are not a number.
template <class T>
bool isSame(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// @returns the share of points that the thinning at half a spacing keeps
double expectTheDefinition(const Isosurface& surface)
{
  double share = 1.0;
  for (const double minimumSpacing : spacings)
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
    if (minimumSpacing == 0.5 && !surface.edges.empty())
    {
      share = static_cast<double>(found.edges.size()) / static_cast<double>(surface.edges.size());
    }
  }
  return share;
}

Isosurface extracted(const clouds::Cloud& cloud, double isovalue, FitOrder order = FitOrder::Cubic,
  std::size_t threads = 1, bool move = true)
{
  const isopoint::Execution execution = clouds::executionOn(threads);
  isopoint::IsosurfaceExtractor extractor;
  extractor.load<double, double>(execution, cloud.size(), clouds::readerOf(cloud));
  return clouds::extractFrom(extractor, 
    execution, isovalue, isopoint::defaultAngle, 0.0, FitRequest{ order, move });
}

/// A surface of any fits.
Isosurface surfaceOf(std::vector<LocalFit> fits)
{
  Isosurface surface;
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    surface.edges.push_back({ i, i + 1, 0.5 });
    surface.positions.push_back(fits[i].position);
    surface.decreasingEdges.push_back({ 0.0, 0.0, 1.0 });
  }
  surface.fits = std::move(fits);
  return surface;
}

/// Points in a cube, with gradients mostly along one axis and spacings that vary by a factor.
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
    fit.order = random() < 0.1 ? std::nullopt : std::optional<FitOrder>(FitOrder::Quadratic);
  }
  return fits;
}

clouds::Cloud sampled(std::size_t count, const std::function<double(double, double, double)>& value)
{
  clouds::Cloud cloud = clouds::uniform(count, 61);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* const p = cloud.positions.data() + 3 * i;
    cloud.values[i] = value(p[0], p[1], p[2]);
  }
  return cloud;
}

/// Each point that was dropped has one of its own sheet that was kept within its reach.
/// @param sheetOf tells sheets apart by their places
void expectThinnedBySheets(const Isosurface& surface, double minimumSpacing,
  const std::function<int(const Vector&)>& sheetOf)
{
  const Isosurface kept = thinned(surface, minimumSpacing);
  EXPECT_LT(kept.edges.size(), surface.edges.size());
  for (const LocalFit& fit : surface.fits)
  {
    ASSERT_TRUE(std::any_of(kept.fits.begin(), kept.fits.end(),
      [&](const LocalFit& other)
      {
        return sheetOf(other.position) == sheetOf(fit.position) &&
               isopoint::lengthOf(isopoint::difference(other.position, fit.position)) <
                 minimumSpacing * fit.spacing;
      }));
  }
}

} // namespace

TEST(Thinning, IsThatOfTheDefinition)
{
  constexpr std::size_t count = 2000;
  for (const FitOrder order : { FitOrder::Linear, FitOrder::Cubic, FitOrder::Crease })
  {
    EXPECT_LT(expectTheDefinition(extracted(clouds::uniform(count, 62), 0.3, order)), 0.9);
    expectTheDefinition(extracted(clouds::clustered(count, 63), -4.0, order));
    expectTheDefinition(extracted(clouds::lattice(12, 13, 14), 2.0, order));
    expectTheDefinition(extracted(clouds::coarse(900, 6, 64), 4.5, order));
    expectTheDefinition(extracted(clouds::coincident(clouds::uniform(count, 65), 0.3), 0.3, order));
    expectTheDefinition(extracted(clouds::flattened(clouds::uniform(count, 66), 2), 0.4, order));
  }
  expectTheDefinition(extracted(clouds::uniform(count, 67), 0.3, FitOrder::Cubic, 1, false));
  expectTheDefinition(extracted(clouds::uniform(count, 67), 9.0));
}

TEST(Thinning, IsThatOfTheDefinitionForAnySpacings)
{
  for (const double factor : { 1.0, 1e3, 1e12 })
  {
    EXPECT_LT(expectTheDefinition(surfaceOf(randomFits(3000, 1.0, factor, 68))), 1.0);
  }
}

TEST(Thinning, IsThatOfTheDefinitionAtAnyScale)
{
  for (const double side : { 1e-320, 1e-300, 1e-100, 1e100, 1e289, 1e292, 1e308 })
  {
    SCOPED_TRACE(side);
    expectTheDefinition(surfaceOf(randomFits(600, side, 30.0, 69)));
  }
}

// Coordinates have few digits left for what lies between the points.
TEST(Thinning, IsThatOfTheDefinitionFarOffTheOrigin)
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

// Distances that are exactly the reach, at the borders of any grid.
TEST(Thinning, IsThatOfTheDefinitionOnALattice)
{
  std::vector<LocalFit> fits;
  for (int i = 0; i < 2000; ++i)
  {
    LocalFit fit{};
    fit.position = { (i * 7 % 20 - 10) * 0.25, (i * 11 % 21 - 10) * 0.25, (i % 5 - 2) * 0.125 };
    fit.gradient = { 0.0, 0.0, i % 3 == 0 ? -1.0 : 1.0 };
    fit.spacing = i % 4 == 0 ? 1.0 : 0.5;
    fit.order = FitOrder::Quadratic;
    fits.push_back(fit);
  }
  EXPECT_LT(expectTheDefinition(surfaceOf(fits)), 0.9);
}

TEST(Thinning, PointsThatTellOfNoSheetAreLeftAlone)
{
  LocalFit usable{};
  usable.gradient = { 1.0, 0.0, 0.0 };
  usable.spacing = 1.0;
  usable.order = FitOrder::Cubic;
  EXPECT_EQ(thinned(surfaceOf({ usable, usable, usable }), 0.5).edges.size(), 1u);
  const auto expectKept = [&](LocalFit fit)
  {
    EXPECT_EQ(thinned(surfaceOf({ fit, fit }), 0.5).edges.size(), 2u);
    EXPECT_EQ(thinned(surfaceOf({ fit, usable }), 0.5).edges.size(), 2u);
    EXPECT_EQ(thinned(surfaceOf({ usable, fit }), 0.5).edges.size(), 2u);
  };
  LocalFit fit = usable;
  fit.order = std::nullopt;
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

TEST(Thinning, NothingGoesAtZeroOrWithoutFits)
{
  Isosurface surface = surfaceOf(randomFits(1000, 1.0, 10.0, 71));
  EXPECT_EQ(thinned(surface, 0.0).edges.size(), 1000u);
  surface.fits.clear();
  EXPECT_EQ(thinned(surface, 1.0).edges.size(), 1000u);
}

TEST(Thinning, KeepsTheMergedSamplesThatPointsEndAt)
{
  const clouds::Cloud cloud = clouds::coarse(4000, 12, 72);
  clouds::Cloud smooth = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    smooth.values[i] = cloud.positions[3 * i] + 0.3 * cloud.positions[3 * i + 1];
  }
  const Isosurface surface = extracted(smooth, 6.1);
  const Isosurface few = thinned(surface, 1.0);
  ASSERT_LT(few.edges.size(), surface.edges.size());
  std::set<std::uint64_t> ends;
  for (const isopoint::IsopointEdge& point : few.edges)
  {
    ends.insert({ point.first, point.second });
  }
  std::vector<std::vector<std::uint64_t>> expected;
  for (const isopoint::CoincidentSamples& group : surface.coincident)
  {
    if (ends.count(group.ids.front()) > 0)
    {
      expected.push_back(group.ids);
    }
  }
  ASSERT_LT(expected.size(), surface.coincident.size());
  ASSERT_EQ(few.coincident.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(few.coincident[i].ids, expected[i]);
  }
}

// Sheets a third, or a tenth, of the samples' mean spacing apart.
TEST(Thinning, SheetsCloseByDoNotThinEachOther)
{
  constexpr std::size_t count = 20000;
  const double meanSpacing = 1.0 / std::cbrt(static_cast<double>(count));
  for (const double gap : { 0.33 * meanSpacing, 0.1 * meanSpacing })
  {
    const Isosurface two =
      extracted(sampled(count, [](double, double, double z) { return (z - 0.5) * (z - 0.5); }),
        0.25 * gap * gap);
    const auto half = [](const Vector& p) { return p[2] < 0.5 ? 0 : 1; };
    EXPECT_GT(two.edges.size(), 100u);
    for (const double minimumSpacing : { 1.0, 0.5 })
    {
      expectThinnedBySheets(two, minimumSpacing, half);
    }
  }
}

// The outer ones have equal gradients.
TEST(Thinning, ThreeSheetsCloseByDoNotThinEachOther)
{
  constexpr double gap = 0.2;
  clouds::Random random(75);
  std::vector<LocalFit> fits(3000);
  for (std::size_t i = 0; i < fits.size(); ++i)
  {
    const double sheet = static_cast<double>(i % 3);
    const double x = 10.0 * random();
    fits[i].position = { x, 10.0 * random(), gap * (sheet + 0.2 * random()) };
    fits[i].gradient = { 0.0, 0.0, i % 3 == 1 ? -1.0 : 1.0 };
    fits[i].spacing = 1.0;
    fits[i].order = FitOrder::Cubic;
  }
  const auto third = [](const Vector& p) { return static_cast<int>(p[2] / gap); };
  for (const double minimumSpacing : { 1.0, 0.5 })
  {
    expectThinnedBySheets(surfaceOf(fits), minimumSpacing, third);
  }
}

// A roof whose sides meet at an angle of 140 degrees.
TEST(Thinning, SidesOfACreaseDoNotThinEachOther)
{
  const double slope = std::tan(20.0 * 3.14159265358979323846 / 180.0);
  const Isosurface roof = extracted(sampled(20000, [slope](double x, double, double z)
                                      { return z - 0.5 + slope * std::abs(x - 0.5); }),
    0.0, FitOrder::Crease);
  Isosurface sides = roof;
  sides.edges.clear();
  sides.positions.clear();
  sides.decreasingEdges.clear();
  sides.fits.clear();
  for (std::size_t i = 0; i < roof.edges.size(); ++i)
  {
    if (roof.fits[i].order != std::nullopt)
    {
      sides.edges.push_back(roof.edges[i]);
      sides.positions.push_back(roof.positions[i]);
      sides.decreasingEdges.push_back(roof.decreasingEdges[i]);
      sides.fits.push_back(roof.fits[i]);
    }
  }
  const Isosurface kept = thinned(sides, 1.0);
  EXPECT_LT(kept.edges.size(), sides.edges.size() / 2);
  const auto facesTo = [](const LocalFit& fit) { return fit.gradient[0] < 0.0; };
  for (const LocalFit& fit : sides.fits)
  {
    if (std::abs(fit.gradient[0]) > 0.3 * isopoint::lengthOf(fit.gradient))
    {
      EXPECT_TRUE(std::any_of(kept.fits.begin(), kept.fits.end(),
        [&](const LocalFit& other)
        {
          return facesTo(other) == facesTo(fit) && isopoint::lengthOf(isopoint::difference(
                                                     other.position, fit.position)) <= fit.spacing;
        }));
    }
  }
}

TEST(Thinning, IsTheSameForAnyNumberOfThreads)
{
  const clouds::Cloud cloud = clouds::uniform(60000, 73);
  const Isosurface expected = thinned(extracted(cloud, 0.3, FitOrder::Cubic, 1), 0.5);
  EXPECT_FALSE(expected.edges.empty());
  for (const std::size_t threads : { 2, 3 })
  {
    Isosurface found = extracted(cloud, 0.3, FitOrder::Cubic, threads);
    isopoint::thin(clouds::executionOn(threads), 0.5, found);
    ASSERT_EQ(found.edges.size(), expected.edges.size());
    for (std::size_t i = 0; i < expected.edges.size(); ++i)
    {
      ASSERT_TRUE(isSame(found.edges[i], expected.edges[i]));
      ASSERT_TRUE(isSame(found.fits[i].position, expected.fits[i].position));
    }
  }
}

TEST(Thinning, AnAbortLeavesTheSurfaceAsItWas)
{
  const Isosurface all = surfaceOf(randomFits(20000, 1.0, 10.0, 74));
  for (int patience = 0; patience < 2; ++patience)
  {
    Isosurface surface = all;
    isopoint::Execution impatient;
    int asked = 0;
    impatient.aborted = [&]() { return asked++ >= patience; };
    EXPECT_THROW(isopoint::thin(impatient, 0.5, surface), isopoint::Aborted);
    EXPECT_EQ(surface.edges.size(), all.edges.size());
    EXPECT_EQ(surface.fits.size(), all.fits.size());
  }
}
