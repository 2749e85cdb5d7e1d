// SPDX-License-Identifier: GPL-3.0-or-later
// The crossing tetrahedra in gaps: against a search of CGAL's tetrahedralization, and against
// clouds with and without gaps.
#include "GapDefinition.h"
#include "RandomClouds.h"

namespace
{

using clouds::Cloud;
using clouds::fromMiddle;
using clouds::Vector;
using triangles::Corners;

std::vector<Corners> foundInGaps(
  const Cloud& cloud, double isovalue, std::size_t threads = 1, bool keepsHullSlivers = false)
{
  return triangles::TetrahedraSearch<>(cloud, threads).inGaps(isovalue, keepsHullSlivers);
}

double shareInGaps(const Cloud& cloud, double isovalue)
{
  const auto all = triangles::FullTetrahedralization(cloud).tetrahedra(isovalue);
  return static_cast<double>(foundInGaps(cloud, isovalue).size()) / static_cast<double>(all.size());
}

std::vector<Corners> expectedInGaps(const Cloud& cloud, double isovalue, bool keepsHullSlivers)
{
  const triangles::FullTetrahedralization full(cloud);
  const std::vector<gaps::Tetrahedron> all = gaps::tetrahedraOf(
    cloud, full, isovalue, keepsHullSlivers ? gaps::Kind::Slice : gaps::Kind::Surface);
  const std::vector<bool> areInGaps = gaps::areInGaps(all);
  std::vector<Corners> result;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (areInGaps[i])
    {
      result.push_back(full.cornersOf(all[i].cell));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

} // namespace

TEST(GapTetrahedra, AreThoseOfTheDefinition)
{
  const auto expectSame = [](const Cloud& cloud, double isovalue)
  {
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const bool keepsHullSlivers : { false, true })
    {
      const std::vector<Corners> expected = expectedInGaps(cloud, isovalue, keepsHullSlivers);
      EXPECT_TRUE(foundInGaps(cloud, isovalue, 1, keepsHullSlivers) == expected);
      least = std::min(least, expected.size());
    }
    return least;
  };
  // Blades of random samples with void between them, joined along one side.
  const Cloud comb =
    clouds::withValuesOf(clouds::filtered(clouds::uniform(3000, 1), [](const Vector& p)
                           { return p[0] < 0.2 || std::fmod(p[1], 0.4) < 0.2; }),
      [](const Vector& p) { return p[2]; });
  EXPECT_GT(expectSame(comb, 0.5), 100u);
  expectSame(clouds::clustered(1500, 2), -4.0);
  EXPECT_GT(expectSame(clouds::lines(1500, 20, 0, 3), 0.3), 0u);
  EXPECT_GT(expectSame(clouds::momentCurve(150), 0.5), 100u);
  EXPECT_GT(expectSame(clouds::helix(420), 0.5), 100u); // hundreds of tetrahedra at each sample
  expectSame(clouds::twoSkewLines(150), 0.4);
  expectSame(clouds::tiltedWells(8, 40, 1), 0.2);
  expectSame(clouds::uniform(2000, 4), 0.3);
  expectSame(clouds::lattice(10, 11, 12), 2.0);
  expectSame(clouds::coincident(clouds::uniform(1000, 5), 0.6), 0.3);
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed)
  {
    SCOPED_TRACE(seed);
    clouds::Dice dice(seed);
    const Cloud cloud = clouds::randomCloud(dice, seed);
    all += cloud.size() == 0 ? 0 : expectSame(cloud, cloud.values[dice(cloud.size())]);
  }
  EXPECT_GT(all, 100u);
}

TEST(GapTetrahedra, AreNoneOfClosedSurfacesAmidSamples)
{
  const auto fromRing = [](const Vector& p)
  { return std::hypot(std::hypot(p[0] - 0.5, p[1] - 0.5) - 0.3, p[2] - 0.5); };
  for (const std::size_t count : { 20000, 200000 })
  {
    const Cloud cloud = clouds::uniform(count, 6);
    EXPECT_TRUE(foundInGaps(clouds::withValuesOf(cloud, fromMiddle), 0.35, 2).empty());
    EXPECT_TRUE(foundInGaps(clouds::withValuesOf(cloud, fromRing), 0.1, 2).empty());
    Cloud normal;
    std::mt19937_64 random(7);
    std::normal_distribution<double> distribution;
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector p{ distribution(random), distribution(random), distribution(random) };
      normal.add(p, isopoint::lengthOf(p));
    }
    EXPECT_TRUE(foundInGaps(normal, 1.0, 2).empty());
    EXPECT_TRUE(foundInGaps(normal, 2.0, 2).empty());
  }
}

/// A ball of samples within others, with a void between that the surface lies in: it stays closed
/// where it is no wider than samples are apart, and goes where it is far wider.
TEST(GapTetrahedra, AreAllAcrossAVoidAllAround)
{
  const auto inGaps = [](double width)
  {
    const auto isOutside = [width](const Vector& p)
    { return std::abs(fromMiddle(p) - 0.3) > 0.5 * width; };
    return shareInGaps(
      clouds::withValuesOf(clouds::filtered(clouds::uniform(20000, 8), isOutside), fromMiddle),
      0.3);
  };
  EXPECT_EQ(inGaps(0.01), 0.0);
  EXPECT_GT(inGaps(0.3), 0.99);
}

/// Nothing lies behind a sheet that is one sample thick, so that the ends of edges from a body to
/// it cannot agree on the spacing.
TEST(GapTetrahedra, AreThoseBetweenABodyAndASheet)
{
  clouds::Random random(9);
  Cloud cloud;
  for (int i = 0; i < 8600; ++i)
  {
    const auto [x, y, height] = random.place();
    const double z = i < 8000 ? 0.5 * height : 1.0 + 0.02 * height;
    cloud.add(x, y, z, z);
  }
  EXPECT_GT(shareInGaps(cloud, 0.75), 0.97);
}

/// Random samples fill their convex hull if slivers there are kept, and only then.
TEST(GapTetrahedra, AreNoneOfASliceThroughABlock)
{
  const Cloud cloud =
    clouds::withValuesOf(clouds::uniform(20000, 12), [](const Vector& p) { return p[0]; });
  EXPECT_GT(foundInGaps(cloud, 0.5).size(), 50u);
  for (const double place : { 0.02, 0.5, 0.9 })
  {
    EXPECT_EQ(foundInGaps(cloud, place, 2, true).size(), 0u);
  }
}

/// There is no gap between slices at equal distances.
TEST(GapTetrahedra, AreFewBetweenSlices)
{
  const Cloud cloud = clouds::withValuesOf(clouds::moved(clouds::uniform(6000, 10), [](double* p)
                                             { p[2] = std::floor(5.0 * p[2]) / 5.0; }),
    [](const Vector& p) { return p[2] + 0.2 * p[0]; });
  for (const double isovalue : { 0.1, 0.5, 0.9 })
  {
    EXPECT_LT(shareInGaps(cloud, isovalue), 0.05) << isovalue;
  }
}
