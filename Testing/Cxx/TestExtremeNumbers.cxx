// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers at the limits of their types, infinite ones and NaN, through the filter; each test states
// the defined result.
#include "DegenerateTesting.h"

#include "vtkCellData.h"
#include "vtkLongLongArray.h"
#include "vtkUnsignedLongLongArray.h"

using namespace degeneratetesting;

namespace
{

template <class TArray>
void expectRoundedToDouble(typename TArray::ValueType first, double range)
{
  const auto cloud = cloudOf(distances(4000));
  const auto whole = newArray<TArray>("f", 4000);
  const auto real = newArray<vtkDoubleArray>("f", 4000);
  for (vtkIdType i = 0; i < 4000; ++i)
  {
    const double distance = cloud->GetPointData()->GetScalars()->GetTuple1(i);
    whole->SetValue(i, first + static_cast<typename TArray::ValueType>(range * distance));
    real->SetValue(i, static_cast<double>(whole->GetValue(i)));
  }
  const double isovalue = static_cast<double>(first) + 0.7 * range;
  cloud->GetPointData()->SetScalars(real);
  // Fits know that integers are rounded: see TestFilterArrays.
  constexpr int projection = vtkScatteredIsopointFilter::NO_PROJECTION;
  const Surface expected = contour(cloud, isovalue, projection);
  EXPECT_GT(expected.count(), 300);
  cloud->GetPointData()->SetScalars(whole);
  const Surface found = contour(cloud, isovalue, projection);
  EXPECT_EQ(pointsOf(found.Output), pointsOf(expected.Output));
}

} // namespace

TEST(ExtremeNumbers, ScaledSamplesHaveTheScaledSurface)
{
  const Surface unscaled = contour(distances(3000), 0.7);
  EXPECT_GT(unscaled.count(), 200);
  for (const double scale : { 0x1p-100, 0x1p-30, 0x1p30, 0x1p100 })
  {
    SCOPED_TRACE(scale);
    const Surface surface =
      contour(changed(distances(3000), [scale](Sample& s)
                { std::for_each(s.begin(), s.begin() + 3, [scale](double& c) { c *= scale; }); }),
        0.7);
    ASSERT_EQ(surface.count(), unscaled.count());
    vtkPointData* const data = surface.Output->GetPointData();
    vtkPointData* const unscaledData = unscaled.Output->GetPointData();
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_EQ(surface.point(i)[axis], scale * unscaled.point(i)[axis]);
        ASSERT_NEAR(data->GetNormals()->GetComponent(i, axis),
          unscaledData->GetNormals()->GetComponent(i, axis), 1e-5);
      }
      ASSERT_FLOAT_EQ(static_cast<float>(data->GetArray("Radius")->GetTuple1(i) / scale),
        static_cast<float>(unscaledData->GetArray("Radius")->GetTuple1(i)));
    }
  }
}

// Coordinates of few significant bits, and close to the largest double.
TEST(ExtremeNumbers, SurfacesAreFiniteNearTheLimitsOfDouble)
{
  for (const double scale : { 1e-320, 1e-310, 1e-200, 1e150, 1e300 })
  {
    SCOPED_TRACE(scale);
    const Surface surface =
      contour(changed(distances(500), [scale](Sample& s)
                { std::for_each(s.begin(), s.begin() + 3, [scale](double& c) { c *= scale; }); }),
        0.7);
    EXPECT_GT(surface.count(), 20);
    for (const double coordinate : pointsOf(surface.Output))
    {
      EXPECT_LE(std::abs(coordinate), scale);
    }
  }
}

// Coordinates whose squares underflow, and curvatures that overflow.
TEST(ExtremeNumbers, ShapesOfTinySurfacesAreFinite)
{
  for (const double scale : { 1e-152, 1e-153, 1e-154, 1e-155 })
  {
    SCOPED_TRACE(scale);
    std::vector<Sample> lattice;
    for (int i = 0; i < 729; ++i)
    {
      const int layer = i / 81;
      const int row = i / 9 % 9;
      const double x = i % 9 - 4;
      const double y = row - 4;
      const double z = layer - 4;
      lattice.push_back({ scale * x, scale * y, scale * z, std::round(2.0 * std::hypot(x, y, z)) });
    }
    const Surface surface = contour(lattice, 5.0);
    EXPECT_GT(surface.count(), 100);
    vtkDataArray* const shapes = surface.Output->GetCellData()->GetArray("SplatPolygon");
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      for (int k = 0; k < shapes->GetNumberOfComponents(); ++k)
      {
        ASSERT_TRUE(std::isfinite(shapes->GetComponent(i, k))) << i << ' ' << k;
      }
    }
  }
}

TEST(ExtremeNumbers, NoPrecisionIsLostFarFromTheOrigin)
{
  const Surface surface =
    contour(changed(distances(20000), [](Sample& s)
              { std::for_each(s.begin(), s.begin() + 3, [](double& c) { c = 1e9 + 0.015 * c; }); }),
      0.7);
  EXPECT_GT(surface.count(), 500);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    const auto p = surface.point(i);
    EXPECT_NEAR(std::hypot(p[0] - 1e9, p[1] - 1e9, p[2] - 1e9) / 0.015, 0.7, 0.03);
  }
}

TEST(ExtremeNumbers, NegativeZeroIsZero)
{
  const Surface surface =
    contour({ { 0.0, 0.0, 0.0, 1.0 }, { -0.0, 0.0, -0.0, 3.0 }, { 1.0, 0.0, 0.0, -2.0 } }, 0.0);
  ASSERT_EQ(surface.count(), 1); // the first two count as one, of value 2
  EXPECT_EQ(surface.point(0)[0], 0.5);
  EXPECT_EQ(contour({ { 0.0, 0.0, 0.0, -0.0 }, { 1.0, 0.0, 0.0, 0.0 } }, 0.0).count(), 0);
}

TEST(ExtremeNumbers, InfiniteIsovaluesAndThoseOutOfRangeHaveNoSurface)
{
  for (const double isovalue : { infinity, -infinity, 1e300, -1e300 })
  {
    EXPECT_EQ(contour(distances(2000), isovalue).count(), 0);
  }
}

TEST(ExtremeNumbers, SamplesThatAreNotFiniteAreLeftOutAndCounted)
{
  const std::vector<Sample> finite = distances(2000);
  std::vector<Sample> all;
  for (const Sample& sample : finite)
  {
    all.push_back(sample);
    if (all.size() % 4 == 0)
    {
      all.push_back(sample);
      all.back()[all.size() / 5 % 4] =
        std::array<double, 3>{ notANumber, infinity, -infinity }[all.size() / 20 % 3];
    }
  }
  const Surface surface = contour(all, 0.7);
  EXPECT_EQ(surface.Skipped, static_cast<vtkIdType>(all.size() - finite.size()));
  EXPECT_GT(surface.count(), 100);
  EXPECT_EQ(pointsOf(surface.Output), pointsOf(contour(finite, 0.7).Output));

  const Surface none = contour(changed(finite, [](Sample& s) { s[1] = notANumber; }), 0.7);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.Skipped, 2000);
}

TEST(ExtremeNumbers, DifferencesOfValuesMayOverflow)
{
  const double largest = std::numeric_limits<double>::max();
  const Surface surface = contour({ { 0.0, 0.0, 0.0, -largest }, { 1.0, 0.0, 0.0, largest } }, 0.0);
  ASSERT_EQ(surface.count(), 1);
  EXPECT_EQ(surface.point(0)[0], 0.5);
}

// Gradients that overflow or are denormal do not determine normals.
TEST(ExtremeNumbers, NormalsAreRightWhereGradientsOverflowOrUnderflow)
{
  const std::array<std::array<double, 2>, 4> scales{ { { 1e30, 1e-300 }, { 1e-20, 1e300 },
    { 1e-5, 1e303 }, { 1.5e-6, 1e302 } } };
  for (const auto& [size, slope] : scales)
  {
    SCOPED_TRACE(size);
    std::vector<Sample> samples = distances(3000);
    for (Sample& sample : samples)
    {
      sample = { size * sample[0], size * sample[1], size * sample[2], slope * (sample[3] - 0.7) };
    }
    const Surface surface = contour(samples, 0.0);
    EXPECT_GT(surface.count(), 200);
    vtkDataArray* const normals = surface.Output->GetPointData()->GetNormals();
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      const std::array<double, 3> p = surface.point(i);
      const double* const n = normals->GetTuple3(i);
      ASSERT_LT((n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / std::hypot(p[0], p[1], p[2]), -0.5);
    }
  }
}

TEST(ExtremeNumbers, IntegersThatDoubleCannotRepresentAreRounded)
{
  expectRoundedToDouble<vtkLongLongArray>((1LL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkLongLongArray>(-(1LL << 53) - 1001, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 62) + (1ULL << 61), 1e6);
}
