// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage by splats: the measure itself against a test of all splats; the filter's splats after
// thinning, for samples on lines and at edges; how far splats extend over borders.
#include "AnalyticFields.h"
#include "FilterTesting.h"
#include "SplatCoverage.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

using analytic::dot;
using analytic::length;
using analytic::Vector;
using splatcoverage::Coverage;
using splatcoverage::Splat;

constexpr double tolerance = 0.02;

Vector randomVector(clouds::Random& random)
{
  const double x = 2.0 * random() - 1.0;
  const double y = 2.0 * random() - 1.0;
  return { x, y, 2.0 * random() - 1.0 };
}

/// Polygons on circles whose sizes vary a thousandfold.
std::vector<Splat> randomSplats(std::size_t count)
{
  clouds::Random random(1);
  std::vector<Splat> splats(count);
  for (Splat& splat : splats)
  {
    splat.center = randomVector(random);
    splat.normal = analytic::directionOf(randomVector(random));
    const Vector first = analytic::directionOf(analytic::cross(splat.normal, randomVector(random)));
    const Vector second = analytic::cross(splat.normal, first);
    const double radius = std::pow(10.0, -3.0 * random());
    for (int i = 0; i < 64; ++i)
    {
      const double angle = 2.0 * analytic::pi * i / 64.0;
      splat.corners.push_back(
        analytic::sum(splat.center, analytic::sum(analytic::scaled(first, radius * std::cos(angle)),
                                      analytic::scaled(second, radius * std::sin(angle)))));
    }
  }
  return splats;
}

/// Whether a place is within the circle of a splat, made larger by a share, seen along the normal.
bool covers(const Splat& splat, const Vector& place, double share)
{
  const Vector way = analytic::difference(place, splat.center);
  const double height = dot(way, splat.normal);
  return std::abs(height) <= std::max(tolerance, 0.5 * splat.radius()) &&
         length(way) * length(way) - height * height <= std::pow(share * splat.radius(), 2);
}

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
    const analytic::Foot foot = surface.footOf(randomVector(random));
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

/// Samples on vertical lines that are several times farther apart than samples on a line, with
/// "distance" from the origin.
vtkSmartPointer<vtkPolyData> newLines(int lines, int samplesOnEach, int seed)
{
  clouds::Random random(static_cast<std::uint64_t>(seed));
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> distances;
  distances->SetName("distance");
  for (int line = 0; line < lines; ++line)
  {
    const double x = 2.0 * random() - 1.0;
    const double y = 2.0 * random() - 1.0;
    const double phase = random();
    for (int i = 0; i < samplesOnEach; ++i)
    {
      const Vector place{ x, y, 2.0 * (i + phase) / samplesOnEach - 1.0 };
      points->InsertNextPoint(place.data());
      distances->InsertNextValue(static_cast<float>(length(place)));
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(distances);
  return cloud;
}

/// Sets the scalars to the values of a field.
void setValues(vtkPolyData* cloud, const std::function<double(const Vector&)>& field)
{
  vtkNew<vtkFloatArray> values;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vector place;
    cloud->GetPoint(i, place.data());
    values->InsertNextValue(static_cast<float>(field(place)));
  }
  cloud->GetPointData()->SetScalars(values);
}

} // namespace

TEST(Coverage, AgreesWithATestOfAllSplats)
{
  std::vector<Splat> splats = randomSplats(300);
  for (Splat& splat : splats) // all are seen along one direction
  {
    splat.normal = splats[0].normal;
    const std::vector<Vector> corners = splat.corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const Vector along = analytic::difference(splats[0].corners[i], splats[0].center);
      splat.corners[i] =
        analytic::sum(splat.center, analytic::scaled(analytic::directionOf(along),
                                      length(analytic::difference(corners[i], splat.center))));
    }
  }
  const Coverage coverage(splats, tolerance);
  clouds::Random random(2);
  int covered = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i)
  {
    const Vector place = randomVector(random);
    const auto expected = [&](double share)
    {
      return std::any_of(splats.begin(), splats.end(),
        [&](const Splat& splat) { return covers(splat, place, share); });
    };
    const bool isCovered = coverage.covers(place, splats[0].normal);
    ASSERT_TRUE(isCovered || !expected(0.99)); // a polygon of 64 corners on the circle
    ASSERT_TRUE(!isCovered || expected(1.001));
    covered += isCovered ? 1 : 0;
  }
  EXPECT_GT(covered, count / 20);
  EXPECT_LT(covered, count * 19 / 20);
}

TEST(Coverage, SplatsAreReadFromTheArrays)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1.0, 2.0, 3.0);
  cloud->SetPoints(points);
  EXPECT_TRUE(splatcoverage::splatsOf(cloud).empty());

  const auto add =
    [](vtkDataSetAttributes* attributes, const char* name, std::initializer_list<float> tuple)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(tuple.size()));
    array->InsertNextTuple(tuple.begin());
    attributes->AddArray(array);
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
  const auto beside = [&](double x, double y) {
    return analytic::sum(fan[0].center, Vector{ x, y, 0.0 });
  };
  EXPECT_TRUE(coverage.covers(beside(0.0, 0.9), { 0.0, 0.0, 1.0 }));
  EXPECT_FALSE(coverage.covers(beside(0.9, 0.9), { 0.0, 0.0, 1.0 }));
  EXPECT_TRUE(coverage.covers(beside(0.9, -0.9), { 0.0, 0.0, 1.0 }));
}

TEST(Coverage, ThinnedPointsCoverASphere)
{
  const analytic::Surface sphere = analytic::sphere();
  constexpr vtkIdType samples = 50000;
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(filtertesting::newCloud(samples));
  filter->SetValue(0, sphere.isovalue);
  filter->Update();
  const vtkIdType all = filter->GetOutput()->GetNumberOfPoints();
  for (const int projection :
    { vtkScatteredIsopointFilter::NO_PROJECTION, vtkScatteredIsopointFilter::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    for (const double minimumSpacing : { 0.25, 0.5, 0.75 })
    {
      SCOPED_TRACE(testing::Message() << projection << ", " << minimumSpacing);
      filter->SetMinimumSpacing(minimumSpacing);
      filter->Update();
      EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), 0.75 * all);
      const int uncovered =
        countUncovered(filter->GetOutput(), 2.0 / std::cbrt(static_cast<double>(samples)), sphere);
      EXPECT_LE(uncovered, minimumSpacing > 0.5 ? 150 : 25); // of 50,000
    }
  }
}

TEST(Coverage, SamplesInLinesCoverASphere)
{
  constexpr int lines = 640;
  constexpr int samplesOnEach = 100;
  const analytic::Surface sphere = analytic::sphere();
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetValue(0, sphere.isovalue);
  for (int seed = 1; seed <= 6; ++seed)
  {
    filter->SetInputData(newLines(lines, samplesOnEach, seed));
    filter->Update();
    EXPECT_LT(
      countUncovered(filter->GetOutput(), 2.0 / std::cbrt(lines * samplesOnEach), sphere), 150)
      << seed; // of 50,000
  }
}

TEST(Coverage, SplatsMeetAtACubesEdges)
{
  constexpr int places = 400000;
  const analytic::Surface cube = analytic::cube();
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetValue(0, cube.isovalue);
  filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
  const auto uncoveredOf = [&](vtkPolyData* cloud)
  {
    setValues(cloud, cube.value);
    filter->SetInputData(cloud);
    filter->Update();
    return countUncovered(filter->GetOutput(), 0.05, cube, places);
  };
  for (const vtkIdType samples : { 100000, 150000, 200000 })
  {
    EXPECT_LT(uncoveredOf(filtertesting::newCloud(samples)), places / 800) << samples;
  }
  EXPECT_LT(uncoveredOf(newLines(640, 100, 1)), places / 150);
  EXPECT_LT(uncoveredOf(newLines(640, 100, 2)), places / 150);
}

// At the border of a ball of samples, one per unit of volume, parallel sheets close to a splat's
// own do not make it extend farther.
TEST(Coverage, SplatsDoNotExtendFarOverABorderBesideOtherSheets)
{
  constexpr double ball = 14.0;
  clouds::Random random(5);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> waves;
  while (points->GetNumberOfPoints() < 11494)
  {
    const Vector place = analytic::scaled(randomVector(random), ball);
    if (length(place) < ball)
    {
      points->InsertNextPoint(place.data());
      waves->InsertNextValue(static_cast<float>(std::sin(0.25 * 3.14159265358979 * place[2])));
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(waves);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.0);
  filter->Update();
  const double farthest =
    farthestRim(filter->GetOutput(), [](const Vector& place) { return length(place) - ball; });
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, 4.5);
}

// A gyroid leaves the samples' cube on all sides. Tangent cells of isopoints at the border are open
// there, or bounded far outside by other isopoints of the border; splats do not fill them.
TEST(Coverage, SplatsDoNotExtendFarBeyondTheSamples)
{
  constexpr vtkIdType samples = 20000;
  const auto cloud = filtertesting::newCloud(samples);
  setValues(cloud,
    [](const Vector& p)
    {
      return std::sin(5.0 * p[0]) * std::cos(5.0 * p[1]) +
             std::sin(5.0 * p[1]) * std::cos(5.0 * p[2]) +
             std::sin(5.0 * p[2]) * std::cos(5.0 * p[0]);
    });
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.0);
  filter->Update();
  const double spacing = 2.0 / std::cbrt(static_cast<double>(samples));
  const double farthest = farthestRim(filter->GetOutput(),
    [](const Vector& p) {
      return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) - 1.0;
    });
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, 2.3 * spacing);
}

// Most cells that touch those of a wall of two layers of samples are of other walls.
TEST(Coverage, SplatsOfThinWallsDoNotReachAcrossVoids)
{
  constexpr double distance = 10.0; // of walls, in spacings
  clouds::Random random(7);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> heights;
  for (int wall = 0; wall < 4; ++wall)
  {
    for (int i = 0; i < 2 * 40 * 40; ++i)
    {
      const auto jittered = [&random](int k) { return k + 0.3 * (random() - 0.5); };
      const Vector place{ jittered(i / 2 % 40), distance * wall + jittered(i % 2),
        jittered(i / 80) };
      points->InsertNextPoint(place.data());
      heights->InsertNextValue(static_cast<float>(place[2] + 0.2 * place[0]));
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(heights);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 23.3);
  filter->Update();
  const auto toWall = [](const Vector& p)
  {
    const double wall = std::clamp(std::round((p[1] - 0.5) / distance), 0.0, 3.0);
    return std::abs(p[1] - 0.5 - distance * wall) - 0.5;
  };
  const std::vector<Splat> splats = splatcoverage::splatsOf(filter->GetOutput());
  const auto outside = std::count_if(splats.begin(), splats.end(),
    [&](const Splat& splat)
    {
      return std::any_of(splat.corners.begin(), splat.corners.end(),
        [&](const Vector& corner) { return toWall(corner) > 1.0; });
    });
  EXPECT_GT(splats.size(), 300u);
  EXPECT_LT(outside, 0.1 * static_cast<double>(splats.size()));
}
