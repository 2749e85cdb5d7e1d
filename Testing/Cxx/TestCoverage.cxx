// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage by splats: for samples on lines and at edges; how far splats extend over
// borders.
#include "AnalyticFields.h"
#include "SplatCoverage.h"

using namespace filtertesting;

namespace
{

using splatcoverage::Coverage;
using splatcoverage::Splat;

/// The number of random surface points, nearest to random places, that no splat covers. Points on
/// edges do not count: there the splats of both sides meet up to rounding only.
int countUncovered(
  vtkPolyData* isopoints, double meanSpacing, const analytic::Surface& surface, int places = 50000)
{
  const std::vector<Splat> splats = splatcoverage::splatsOf(isopoints);
  const Coverage coverage(splats, 0.25 * meanSpacing);
  clouds::Random random(3);
  int uncovered = 0;
  for (int i = 0; i < places; ++i)
  {
    const analytic::Foot foot = surface.footOf(random.inCube(2.0));
    uncovered += foot.normals.size() == 1 && !coverage.covers(foot.point, foot.normals[0]) ? 1 : 0;
  }
  return uncovered;
}

/// The largest distance of a place on the rim of any splat.
template <class Distance>
double farthestRim(vtkPolyData* isopoints, const Distance& distanceOf)
{
  double farthest = 0.0;
  for (const Splat& splat : splatcoverage::splatsOf(isopoints))
  {
    for (const Vector& corner : splat.corners)
    {
      farthest = std::max(farthest, distanceOf(corner));
    }
  }
  return farthest;
}

/// Samples on vertical lines that are several times farther apart than samples on a line.
vtkSmartPointer<vtkPolyData> newLines(const analytic::Surface& surface, int seed)
{
  clouds::Random random(static_cast<std::uint64_t>(seed));
  Samples samples;
  for (int line = 0; line < 640; ++line)
  {
    const double x = 2.0 * random() - 1.0;
    const double y = 2.0 * random() - 1.0;
    const double phase = random();
    for (int i = 0; i < 100; ++i)
    {
      const double z = 2.0 * (i + phase) / 100 - 1.0;
      samples.push_back({ x, y, z, surface.value({ x, y, z }) });
    }
  }
  return cloudOf(samples);
}

} // namespace

// The measure finds splats by a grid. If it missed some, the other tests would fail.
TEST(Coverage, SplatsAreReadFromTheArraysAndCoverTheirPolygons)
{
  const auto cloud = cloudOf({ { 1.0, 2.0, 3.0, 0.0 } });
  EXPECT_TRUE(splatcoverage::splatsOf(cloud).empty());
  const auto add = [](vtkDataSetAttributes* data, const char* name, const std::vector<float>& tuple)
  {
    const auto array = newArray(name, 1, static_cast<int>(tuple.size()));
    array->SetTypedTuple(0, tuple.data());
    data->AddArray(array);
  };
  add(cloud->GetPointData(), "Normals", { 0.0f, 0.0f, 1.0f });
  cloud->GetPointData()->SetActiveNormals("Normals");
  add(cloud->GetCellData(), "SplatAxis", { 0.0f, 2.0f, 0.0f });
  add(cloud->GetCellData(), "SplatPolygon",
    { 1.0f, 0.0f, 0.25f, 0.0f, 0.0f, 0.0f, 0.5f, 0.0f, 0.0f, 0.0f, -0.5f, -0.5f, 0.0f, 0.0f, 0.0f,
      -0.5f, -0.5f, 0.0f, 0.0f, 0.0f });
  const std::vector<Splat> fan = splatcoverage::splatsOf(cloud);
  // Across the axis is the normal times that: -x.
  EXPECT_EQ(fan.at(0).corners,
    (std::vector<Vector>{ { 1.0, 4.0, 3.5 }, { 0.0, 2.0, 3.0 }, { 2.0, 1.0, 3.0 } }));
  const Coverage coverage(fan, 0.1);
  const auto covers = [&](double x, double y, double z = 0.0) {
    return coverage.covers(fan[0].center + Vector{ x, y, z }, { 0.0, 0.0, 1.0 });
  };
  EXPECT_TRUE(covers(0.0, 0.9));
  EXPECT_FALSE(covers(0.9, 0.9));
  EXPECT_TRUE(covers(0.9, -0.9));
  EXPECT_FALSE(covers(-1.1, 0.0));
  const double reach = 0.5 * fan[0].radius(); // along the normal
  EXPECT_TRUE(covers(0.0, 0.9, 0.99 * reach));
  EXPECT_FALSE(covers(0.0, 0.9, 1.01 * reach));
  EXPECT_FALSE(covers(0.0, 0.9, -1.01 * reach));
}

TEST(Coverage, SamplesInLinesCoverASphere)
{
  const analytic::Surface sphere = analytic::sphere();
  for (int seed = 1; seed <= 6; ++seed)
  {
    const auto filter = newFilter(newLines(sphere, seed), sphere.isovalue);
    EXPECT_LT(countUncovered(outputOf(filter), 0.05, sphere), 150) << seed; // of 50,000
  }
}

TEST(Coverage, SplatsMeetAtACubesEdges)
{
  constexpr int places = 400000;
  const analytic::Surface cube = analytic::cube();
  const auto countUncoveredOf = [&](vtkPolyData* cloud)
  {
    const auto filter = newFilter(cloud, cube.isovalue);
    filter->SetProjection(Isopoints::CREASE_FIT);
    return countUncovered(outputOf(filter), 0.05, cube, places);
  };
  for (const vtkIdType samples : { 100000, 150000, 200000 })
  {
    const auto cloud = newCloud(samples);
    setScalars(cloud, cube.value);
    EXPECT_LT(countUncoveredOf(cloud), places / 800) << samples;
  }
  EXPECT_LT(countUncoveredOf(newLines(cube, 1)), places / 150);
  EXPECT_LT(countUncoveredOf(newLines(cube, 2)), places / 150);
}

// At the border of a ball of samples, one per unit of volume, parallel sheets close to a splat's
// own do not make it extend farther.
TEST(Coverage, SplatsDoNotExtendFarOverABorderBesideOtherSheets)
{
  constexpr double ball = 14.0;
  clouds::Random random(5);
  Samples samples;
  while (samples.size() < 11494)
  {
    const Vector p = ball * random.inCube(2.0);
    if (length(p) < ball)
    {
      samples.push_back({ p[0], p[1], p[2], std::sin(0.25 * analytic::pi * p[2]) });
    }
  }
  const double farthest = farthestRim(outputOf(newFilter(cloudOf(samples), 0.0)),
    [](const Vector& place) { return length(place) - ball; });
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, 4.5);
}

// A gyroid leaves the samples' cube on all sides. Tangent cells of isopoints at the border are open
// there, or bounded far outside by other isopoints of the border; splats do not fill them.
TEST(Coverage, SplatsDoNotExtendFarBeyondTheSamples)
{
  constexpr vtkIdType samples = 20000;
  const auto cloud = newCloud(samples);
  setScalars(cloud,
    [](const Vector& p)
    {
      return std::sin(5.0 * p[0]) * std::cos(5.0 * p[1]) +
             std::sin(5.0 * p[1]) * std::cos(5.0 * p[2]) +
             std::sin(5.0 * p[2]) * std::cos(5.0 * p[0]);
    });
  const double farthest = farthestRim(outputOf(newFilter(cloud, 0.0)),
    [](const Vector& p) {
      return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) - 1.0;
    });
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, 2.3 * 2.0 / std::cbrt(samples));
}

// Walls of two layers of samples. Most cells that touch those of a wall belong to other walls.
TEST(Coverage, SplatsOfThinWallsDoNotReachAcrossVoids)
{
  constexpr double distance = 10.0; // of walls, in spacings
  clouds::Random random(7);
  Samples samples;
  for (int i = 0; i < 4 * 2 * 40 * 40; ++i)
  {
    const auto jittered = [&random](int k) { return k + 0.3 * (random() - 0.5); };
    const double x = jittered(i / 2 % 40);
    const double y = distance * (i / 3200 % 4) + jittered(i % 2);
    const double z = jittered(i / 80 % 40);
    samples.push_back({ x, y, z, z + 0.2 * x });
  }
  const std::vector<Splat> splats =
    splatcoverage::splatsOf(outputOf(newFilter(cloudOf(samples), 23.3)));
  const auto isOutside = [](const Vector& p)
  {
    const double wall = std::clamp(std::round((p[1] - 0.5) / distance), 0.0, 3.0);
    return std::abs(p[1] - 0.5 - distance * wall) - 0.5 > 1.0;
  };
  const auto outside = std::count_if(splats.begin(), splats.end(),
    [&](const Splat& splat)
    { return std::any_of(splat.corners.begin(), splat.corners.end(), isOutside); });
  EXPECT_GT(splats.size(), 300u);
  EXPECT_LT(outside, 0.1 * static_cast<double>(splats.size()));
}
