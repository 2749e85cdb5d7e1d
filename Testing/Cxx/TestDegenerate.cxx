// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on other methods, through the filter; each test states the defined result.
#include "DegenerateTesting.h"

using namespace degeneratetesting;

TEST(Degenerate, OneSampleHasNoSurface)
{
  EXPECT_EQ(contour({ { 1.0, 2.0, 3.0, 0.5 } }, 0.5).count(), 0);
  EXPECT_EQ(contour({ { 1.0, 2.0, 3.0, 0.5 } }, 0.6).count(), 0);
}

TEST(Degenerate, TwoSamplesHaveOnePointBetweenThem)
{
  const Surface surface = contour({ { 0.0, 0.0, 0.0, 1.0 }, { 4.0, 0.0, 0.0, 3.0 } }, 1.5);
  ASSERT_EQ(surface.count(), 1);
  EXPECT_EQ(surface.point(0), (std::array<double, 3>{ 1.0, 0.0, 0.0 }));
  const double* const normal = surface.Output->GetPointData()->GetNormals()->GetTuple3(0);
  EXPECT_EQ(normal[0], -1.0);
  // 1.1 times half of the edge.
  EXPECT_NEAR(surface.Output->GetPointData()->GetArray("Radius")->GetTuple1(0), 2.2, 1e-6);
}

TEST(Degenerate, ThreeSamplesHaveAPointOnEachEdgeThatCrosses)
{
  const Surface surface =
    contour({ { 0.0, 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0, 2.0 }, { 2.0, 2.0, 0.0, 2.0 } }, 1.0);
  ASSERT_EQ(surface.count(), 2);
  EXPECT_EQ(surface.point(0), (std::array<double, 3>{ 1.0, 0.5, 0.0 }));
  EXPECT_EQ(surface.point(1), (std::array<double, 3>{ 1.0, 1.5, 0.0 }));
}

// A square: its diagonal is within the angle of a side, which is shorter, and is dropped.
TEST(Degenerate, FourSamplesHaveAPointOnEachSideThatCrosses)
{
  const Surface surface = contour({ { 0.0, 0.0, 0.0, 0.0 }, { 0.0, 2.0, 0.0, 2.0 },
                                    { 2.0, 0.0, 0.0, 2.0 }, { 2.0, 2.0, 0.0, 2.0 } },
    1.0);
  ASSERT_EQ(surface.count(), 2);
  EXPECT_EQ(surface.point(0), (std::array<double, 3>{ 0.0, 1.0, 0.0 }));
  EXPECT_EQ(surface.point(1), (std::array<double, 3>{ 1.0, 0.0, 0.0 }));
}

TEST(Degenerate, CollinearSamplesHaveAPointWhereverTheFieldCrosses)
{
  std::vector<Sample> samples;
  for (int i = 0; i < 1000; ++i)
  {
    const int position = (i * 387) % 1000;
    samples.push_back({ 0.0, 0.5 * position, 0.0, position / 100 % 2 ? 1.0 : 0.0 });
  }
  const Surface surface = contour(samples, 0.5);
  ASSERT_EQ(surface.count(), 9);
  std::vector<double> found;
  for (vtkIdType i = 0; i < 9; ++i)
  {
    found.push_back(surface.point(i)[1]);
  }
  std::sort(found.begin(), found.end());
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_EQ(found[i], 0.5 * (100.0 * static_cast<double>(i + 1) - 0.5));
  }
}

TEST(Degenerate, CoplanarSamplesHaveACurveInTheirPlane)
{
  const Surface surface = contour(changed(distances(5000),
                                    [](Sample& s)
                                    {
                                      s[2] = 0.25;
                                      s[3] = std::hypot(s[0], s[1]);
                                    }),
    0.6);
  EXPECT_GT(surface.count(), 100);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    EXPECT_EQ(surface.point(i)[2], 0.25);
    EXPECT_NEAR(std::hypot(surface.point(i)[0], surface.point(i)[1]), 0.6, 0.02);
  }
}

TEST(Degenerate, SamplesThatAllCoincideHaveNoSurface)
{
  const Surface surface =
    contour(changed(distances(1000), [](Sample& s) { s[0] = s[1] = s[2] = 1.0; }), 0.7);
  EXPECT_EQ(surface.count(), 0);
  EXPECT_EQ(surface.Skipped, 0);
}

TEST(Degenerate, CoincidentSamplesCountAsOneWithTheMeanOfTheirValues)
{
  std::vector<Sample> samples = distances(20000);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (i % 10 != 0)
    {
      samples[i] = { 0.0, 0.0, 0.0, i % 2 ? 0.5 : -0.5 };
    }
  }
  const Surface surface = contour(samples, 0.7);
  EXPECT_GT(surface.count(), 300);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    const auto p = surface.point(i);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 0.7, 0.1);
  }
  for (const Surface& none : { contour(samples, -0.1), contour(samples, -0.5) })
  {
    EXPECT_EQ(none.count(), 0); // the mean is about 0: no cell is below
  }
}

TEST(Degenerate, ALatticeHasASphere)
{
  std::vector<Sample> samples;
  for (int i = 0; i < 21 * 21 * 21; ++i)
  {
    const double p[3] = { i % 21 - 10.0, i / 21 % 21 - 10.0, i / 441 - 10.0 };
    samples.push_back({ p[0], p[1], p[2], std::hypot(p[0], p[1], p[2]) });
  }
  const Surface surface = contour(samples, 7.5);
  EXPECT_GT(surface.count(), 700);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    const auto p = surface.point(i);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 7.5, 0.05);
  }
}

TEST(Degenerate, AValueEqualToTheIsovalueIsNotBelow)
{
  const std::vector<Sample> row{ { 0.0, 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0, 1.0 },
    { 2.0, 0.0, 0.0, 2.0 } };
  const Surface surface = contour(row, 1.0);
  ASSERT_EQ(surface.count(), 1);
  EXPECT_EQ(surface.point(0)[0], 1.0);
  EXPECT_EQ(contour(row, 0.0).count(), 0);
  ASSERT_EQ(contour(row, 2.0).count(), 1);
  EXPECT_EQ(contour(row, 2.0).point(0)[0], 2.0);
}

TEST(Degenerate, AConstantFieldHasNoSurface)
{
  const auto samples = changed(distances(2000), [](Sample& s) { s[3] = 5.0; });
  for (const double isovalue : { 5.0, 4.9, 5.1 })
  {
    EXPECT_EQ(contour(samples, isovalue).count(), 0);
  }
}
