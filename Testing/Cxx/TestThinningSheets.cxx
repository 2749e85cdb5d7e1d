// SPDX-License-Identifier: GPL-3.0-or-later
// Thinning of sheets close to each other and of the sides of creases: points of one never stand for
// the other.
#include "ThinningTesting.h"

#include <algorithm>
#include <functional>

using namespace thinningtesting;

namespace
{

/// Random samples of a function in the unit cube.
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

/// Expects a kept point of its own sheet within the minimum spacing of each point.
/// @param sheetOf the sheet that a place is on
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

// Sheets that are a third, or a tenth, of the mean sample spacing apart.
TEST(ThinningSheets, SheetsCloseByDoNotThinEachOther)
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

// The outer two have equal gradients.
TEST(ThinningSheets, ThreeSheetsCloseByDoNotThinEachOther)
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
    fits[i].isSmooth = true;
  }
  const auto third = [](const Vector& p) { return static_cast<int>(p[2] / gap); };
  for (const double minimumSpacing : { 1.0, 0.5 })
  {
    expectThinnedBySheets(surfaceOf(fits), minimumSpacing, third);
  }
}

// A roof whose sides meet at an angle of 140 degrees.
TEST(ThinningSheets, SidesOfACreaseDoNotThinEachOther)
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
    if (roof.fits[i].isSmooth)
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
