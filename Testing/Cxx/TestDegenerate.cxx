// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that break other methods, through the filter; each test states the defined result.
#include "FilterTesting.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkLongLongArray.h"
#include "vtkUnsignedLongLongArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

using namespace filtertesting;

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

using Sample = std::array<double, 4>; // x y z value

vtkSmartPointer<vtkPolyData> cloudOf(const std::vector<Sample>& samples)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto f = newArray<vtkDoubleArray>("f", static_cast<vtkIdType>(samples.size()));
  for (const Sample& sample : samples)
  {
    f->SetValue(points->InsertNextPoint(sample.data()), sample[3]);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(f);
  return cloud;
}

/// A surface that has all its arrays and whose numbers are all finite.
struct Surface
{
  vtkSmartPointer<vtkPolyData> Output;
  vtkIdType Skipped = 0;

  vtkIdType count() const { return this->Output->GetNumberOfPoints(); }
  std::array<double, 3> point(vtkIdType i) const
  {
    std::array<double, 3> p;
    this->Output->GetPoint(i, p.data());
    return p;
  }
};

Surface contour(vtkDataSet* input, double isovalue)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto errors = watchErrors(filter);
  filter->SetInputData(input);
  filter->SetValue(0, isovalue);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  EXPECT_EQ(errors->Count, 0) << errors->Last;
  Surface surface{ filter->GetOutput(), filter->GetNumberOfSkippedSamples() };
  for (const char* const name : { "f", "Normals", "Radius" })
  {
    vtkDataArray* const array = surface.Output->GetPointData()->GetArray(name);
    EXPECT_TRUE(array) << name;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int component = 0; component < array->GetNumberOfComponents(); ++component)
      {
        EXPECT_TRUE(std::isfinite(array->GetComponent(i, component))) << name << " " << i;
      }
    }
  }
  for (const double coordinate : pointsOf(surface.Output))
  {
    EXPECT_TRUE(std::isfinite(coordinate));
  }
  return surface;
}

Surface contour(const std::vector<Sample>& samples, double isovalue)
{
  return contour(cloudOf(samples), isovalue);
}

/// Random samples in a cube of side 2 with the distance to its middle.
std::vector<Sample> ball(std::size_t count)
{
  std::mt19937 random(7);
  std::vector<Sample> samples(count);
  for (Sample& sample : samples)
  {
    std::generate_n(sample.begin(), 3, [&]() { return random() * 0x1p-31 - 1.0; });
    sample[3] = std::hypot(sample[0], sample[1], sample[2]);
  }
  return samples;
}

std::vector<Sample> changed(std::vector<Sample> samples, const std::function<void(Sample&)>& change)
{
  std::for_each(samples.begin(), samples.end(), change);
  return samples;
}

} // namespace

TEST(Degenerate, NoSamplesAreAnErrorAndAnEmptyOutput)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto errors = watchErrors(filter);
  filter->SetInputData(cloudOf({}));
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  expectEmpty(filter->GetOutput());
}

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
  // Half of the edge, and the fifth by which splats overlap where nothing tells of the bend.
  EXPECT_NEAR(surface.Output->GetPointData()->GetArray("Radius")->GetTuple1(0), 2.4, 1e-6);
}

TEST(Degenerate, ThreeSamplesHaveAPointOnEachEdgeThatCrosses)
{
  const Surface surface =
    contour({ { 0.0, 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0, 2.0 }, { 2.0, 2.0, 0.0, 2.0 } }, 1.0);
  ASSERT_EQ(surface.count(), 2);
  EXPECT_EQ(surface.point(0), (std::array<double, 3>{ 1.0, 0.5, 0.0 }));
  EXPECT_EQ(surface.point(1), (std::array<double, 3>{ 1.0, 1.5, 0.0 }));
}

// A square: its diagonal lies within the angle of a side and is dropped.
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

TEST(Degenerate, CoplanarSamplesGiveACurveInTheirPlane)
{
  const Surface surface = contour(changed(ball(5000),
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

TEST(Degenerate, SamplesAtOnePositionHaveNoSurface)
{
  const Surface surface =
    contour(changed(ball(1000), [](Sample& s) { s[0] = s[1] = s[2] = 1.0; }), 0.7);
  EXPECT_EQ(surface.count(), 0);
  EXPECT_EQ(surface.Skipped, 0);
}

// The heap counts as one sample with the mean of its values.
TEST(Degenerate, MostSamplesAtOnePositionCountAsOneWithTheirMean)
{
  std::vector<Sample> samples = ball(20000);
  std::vector<Sample> withOne;
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
    EXPECT_EQ(none.count(), 0); // the mean is about 0, nothing is below
  }
}

TEST(Degenerate, ALatticeGivesAClosedSphere)
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

TEST(Degenerate, AnyScaleGivesTheSameSurfaceScaled)
{
  const Surface unscaled = contour(ball(3000), 0.7);
  for (const double scale : { 0x1p-100, 0x1p-30, 0x1p30, 0x1p100 })
  {
    SCOPED_TRACE(scale);
    const Surface surface =
      contour(changed(ball(3000), [scale](Sample& s)
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

// Positions that differ by a few units of the last place still differ.
TEST(Degenerate, DenormalCoordinatesAndNearTheEndsOfDoubleGiveAFiniteSurface)
{
  for (const double scale : { 1e-320, 1e-310, 1e-200, 1e150, 1e300 })
  {
    SCOPED_TRACE(scale);
    const Surface surface =
      contour(changed(ball(500), [scale](Sample& s)
                { std::for_each(s.begin(), s.begin() + 3, [scale](double& c) { c *= scale; }); }),
        0.7);
    EXPECT_GT(surface.count(), 20);
    for (const double coordinate : pointsOf(surface.Output))
    {
      EXPECT_LE(std::abs(coordinate), scale);
    }
  }
}

TEST(Degenerate, FarFromTheOriginNoDigitIsLost)
{
  const Surface surface =
    contour(changed(ball(20000), [](Sample& s)
              { std::for_each(s.begin(), s.begin() + 3, [](double& c) { c = 1e9 + 0.015 * c; }); }),
      0.7);
  EXPECT_GT(surface.count(), 500);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    const auto p = surface.point(i);
    EXPECT_NEAR(std::hypot(p[0] - 1e9, p[1] - 1e9, p[2] - 1e9) / 0.015, 0.7, 0.03);
  }
}

TEST(Degenerate, NegativeZeroIsZero)
{
  const Surface surface =
    contour({ { 0.0, 0.0, 0.0, 1.0 }, { -0.0, 0.0, -0.0, 3.0 }, { 1.0, 0.0, 0.0, -2.0 } }, 0.0);
  ASSERT_EQ(surface.count(), 1); // the first two count as one, of value 2
  EXPECT_EQ(surface.point(0)[0], 0.5);
  EXPECT_EQ(contour({ { 0.0, 0.0, 0.0, -0.0 }, { 1.0, 0.0, 0.0, 0.0 } }, 0.0).count(), 0);
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
  const auto samples = changed(ball(2000), [](Sample& s) { s[3] = 5.0; });
  for (const double isovalue : { 5.0, 4.9, 5.1 })
  {
    EXPECT_EQ(contour(samples, isovalue).count(), 0);
  }
}

TEST(Degenerate, AnInfiniteIsovalueOrOneOutOfRangeHasNoSurface)
{
  for (const double isovalue : { infinity, -infinity, 1e300, -1e300 })
  {
    EXPECT_EQ(contour(ball(2000), isovalue).count(), 0);
  }
}

TEST(Degenerate, ANaNIsovalueIsAnErrorAndAnEmptyOutput)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto errors = watchErrors(filter);
  filter->SetInputData(cloudOf(ball(100)));
  filter->SetValue(0, notANumber);
  filter->Update();
  EXPECT_EQ(errors->Count, 1);
  expectEmpty(filter->GetOutput());
}

TEST(Degenerate, SamplesThatAreNotFiniteAreLeftOutAndCounted)
{
  const std::vector<Sample> finite = ball(2000);
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
  EXPECT_EQ(pointsOf(surface.Output), pointsOf(contour(finite, 0.7).Output));

  const Surface none = contour(changed(finite, [](Sample& s) { s[1] = notANumber; }), 0.7);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.Skipped, 2000);
}

TEST(Degenerate, ValuesFarApartDoNotOverflow)
{
  const double largest = std::numeric_limits<double>::max();
  const Surface surface = contour({ { 0.0, 0.0, 0.0, -largest }, { 1.0, 0.0, 0.0, largest } }, 0.0);
  ASSERT_EQ(surface.count(), 1);
  EXPECT_EQ(surface.point(0)[0], 0.5);
}

template <class TArray>
void expectRoundedToDouble(typename TArray::ValueType first, double range)
{
  const auto cloud = cloudOf(ball(4000));
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
  const Surface expected = contour(cloud, isovalue);
  EXPECT_GT(expected.count(), 300);
  cloud->GetPointData()->SetScalars(whole);
  const Surface found = contour(cloud, isovalue);
  EXPECT_EQ(pointsOf(found.Output), pointsOf(expected.Output));
}

TEST(Degenerate, IntegersBeyondDoublesDigitsAreRounded)
{
  expectRoundedToDouble<vtkLongLongArray>((1LL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkLongLongArray>(-(1LL << 53) - 1001, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 62) + (1ULL << 61), 1e6);
}

// No order of the input changes the surface: positions, not ids, decide where samples are parted.
TEST(Degenerate, AdversarialOrdersGiveTheSameSurface)
{
  const std::vector<Sample> samples = ball(5000);
  const auto sortedPoints = [](const Surface& surface)
  {
    std::vector<std::array<double, 3>> points;
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      points.push_back(surface.point(i));
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  const auto expected = sortedPoints(contour(samples, 0.7));
  EXPECT_GT(expected.size(), 300u);
  std::vector<Sample> ascending = samples;
  std::sort(ascending.begin(), ascending.end());
  std::vector<Sample> pipe = ascending;
  for (std::size_t i = 0; i < pipe.size(); ++i)
  {
    pipe[i] = ascending[i < pipe.size() / 2 ? 2 * i : 2 * (pipe.size() - i) - 1];
  }
  for (const std::vector<Sample>& order :
    { ascending, std::vector<Sample>(ascending.rbegin(), ascending.rend()), pipe })
  {
    const auto found = sortedPoints(contour(order, 0.7));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(found[i][axis], expected[i][axis], 1e-12);
      }
    }
  }
}

// Gradients that double cannot hold, or not with all their digits, are not taken for normals.
TEST(Degenerate, GradientsBeyondDoubleLeaveNormalsRight)
{
  const std::array<std::array<double, 2>, 4> scales{ { { 1e30, 1e-300 }, { 1e-20, 1e300 },
    { 1e-5, 1e303 }, { 1.5e-6, 1e302 } } };
  for (const auto& [size, slope] : scales)
  {
    SCOPED_TRACE(size);
    std::vector<Sample> samples = ball(3000);
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
