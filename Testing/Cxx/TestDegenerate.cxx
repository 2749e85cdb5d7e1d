// SPDX-License-Identifier: GPL-3.0-or-later
// Hard clouds, and numbers at the limits of their types, infinite or NaN: results follow the
// definition.
#include "FilterTesting.h"

#include "vtkLongLongArray.h"
#include "vtkUnsignedLongLongArray.h"

using namespace filtertesting;

namespace
{

struct Surface
{
  vtkSmartPointer<vtkPolyData> output;
  vtkIdType skipped = 0;

  vtkIdType count() const { return this->output->GetNumberOfPoints(); }
  Vector point(vtkIdType i) const { return placeOf(this->output, i); }
  Vector normal(vtkIdType i) const
  {
    return tupleOf(this->output->GetPointData()->GetNormals(), i);
  }
  double radius(vtkIdType i) const { return findArray(this->output, "Radius")->GetTuple1(i); }
};

/// Updates a filter, and expects no error, all default arrays, and finite numbers.
Surface contour(vtkDataSet* input, double isovalue, int projection = Isopoints::CUBIC_FIT)
{
  const auto filter = newFilter(input, isovalue);
  const auto errors = watchErrors(filter);
  filter->SetProjection(projection);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  Surface surface{ outputOf(filter), filter->GetNumberOfSkippedSamples() };
  EXPECT_EQ(errors->count(), 0u) << errors->last();
  const auto expectFinite = [](const std::vector<double>& numbers, const char* name)
  {
    EXPECT_TRUE(std::all_of(
      numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
      << name;
  };
  expectFinite(pointsOf(surface.output), "positions");
  for (const char* const name : { "f", "Normals", "Radius", "SplatPolygon" })
  {
    EXPECT_TRUE(findArray(surface.output, name)) << name;
    expectFinite(numbersOf(findArray(surface.output, name)), name);
  }
  return surface;
}

Surface contour(const Samples& samples, double isovalue)
{
  return contour(cloudOf(samples), isovalue);
}

/// Expects that all points are about this far from a center, in units of a scale.
void expectSphere(const Surface& surface, vtkIdType minCount, double radius, double tolerance,
  double center = 0.0, double scale = 1.0)
{
  EXPECT_GT(surface.count(), minCount);
  for (vtkIdType i = 0; i < surface.count(); ++i)
  {
    const Vector p = surface.point(i);
    EXPECT_NEAR(std::hypot(p[0] - center, p[1] - center, p[2] - center) / scale, radius, tolerance);
  }
}

Samples changed(Samples samples, const std::function<void(Sample&)>& change)
{
  std::for_each(samples.begin(), samples.end(), change);
  return samples;
}

/// Random samples in a cube of side 2 with the distance to its center as values.
Samples distances(std::size_t count)
{
  std::mt19937 random(7);
  return changed(Samples(count),
    [&](Sample& sample)
    {
      std::generate_n(
        sample.begin(), 3, [&]() { return static_cast<double>(random()) * 0x1p-31 - 1.0; });
      sample[3] = std::hypot(sample[0], sample[1], sample[2]);
    });
}

Samples scaled(const Samples& samples, double scale, double offset = 0.0)
{
  return changed(samples,
    [=](Sample& sample)
    {
      std::for_each(sample.begin(), sample.begin() + 3,
        [=](double& coordinate) { coordinate = offset + scale * coordinate; });
    });
}

template <class TArray>
void expectRoundedToDouble(typename TArray::ValueType first, double range)
{
  const auto cloud = cloudOf(distances(4000));
  vtkDataArray* const distance = cloud->GetPointData()->GetScalars();
  using Value = typename TArray::ValueType;
  const auto whole = arrayOf<TArray>("f", 4000,
    [&](vtkIdType i) { return first + static_cast<Value>(range * distance->GetTuple1(i)); });
  const double isovalue = static_cast<double>(first) + 0.7 * range;
  cloud->GetPointData()->SetScalars(
    arrayOf("f", 4000, [&](vtkIdType i) { return whole->GetValue(i); }));
  // Fits know that integers are rounded.
  const Surface expected = contour(cloud, isovalue, Isopoints::NO_PROJECTION);
  EXPECT_GT(expected.count(), 300);
  cloud->GetPointData()->SetScalars(whole);
  const Surface found = contour(cloud, isovalue, Isopoints::NO_PROJECTION);
  EXPECT_EQ(pointsOf(found.output), pointsOf(expected.output));
}

} // namespace

TEST(Degenerate, EachEdgeThatCrossesHasAPoint)
{
  const Samples row{ { 0.0, 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0, 1.0 }, { 2.0, 0.0, 0.0, 2.0 } };
  const Samples square{ { 0.0, 0.0, 0.0, 0.0 }, { 0.0, 2.0, 0.0, 2.0 }, { 2.0, 0.0, 0.0, 2.0 },
    { 2.0, 2.0, 0.0, 2.0 } };
  constexpr double largest = std::numeric_limits<double>::max();
  Samples line; // on which values alternate
  std::vector<Vector> crossings;
  for (int i = 0; i < 1000; ++i)
  {
    const int position = (i * 387) % 1000;
    line.push_back({ 0.0, 0.5 * position, 0.0, position / 100 % 2 ? 1.0 : 0.0 });
  }
  for (int i = 1; i < 10; ++i)
  {
    crossings.push_back({ 0.0, 50.0 * i - 0.25, 0.0 });
  }
  struct Case
  {
    const char* name;
    Samples samples;
    double isovalue;
    std::vector<Vector> points; // in order of their coordinates
  };
  const std::vector<Case> cases{
    { "one sample at its value", { { 1.0, 2.0, 3.0, 0.5 } }, 0.5, {} },
    { "one sample", { { 1.0, 2.0, 3.0, 0.5 } }, 0.6, {} },
    { "two", { { 0.0, 0.0, 0.0, 1.0 }, { 4.0, 0.0, 0.0, 3.0 } }, 1.5, { { 1.0, 0.0, 0.0 } } },
    { "three", { { 0.0, 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0, 2.0 }, { 2.0, 2.0, 0.0, 2.0 } }, 1.0,
      { { 1.0, 0.5, 0.0 }, { 1.0, 1.5, 0.0 } } },
    // The diagonal is within the angle of a side, which is shorter, and is dropped.
    { "square", square, 1.0, { { 0.0, 1.0, 0.0 }, { 1.0, 0.0, 0.0 } } },
    { "a value equal to the isovalue is not below", row, 1.0, { { 1.0, 0.0, 0.0 } } },
    { "the least value", row, 0.0, {} },
    { "the greatest value", row, 2.0, { { 2.0, 0.0, 0.0 } } },
    { "negative zero is zero: the first two count as one, of value 2",
      { { 0.0, 0.0, 0.0, 1.0 }, { -0.0, 0.0, -0.0, 3.0 }, { 1.0, 0.0, 0.0, -2.0 } }, 0.0,
      { { 0.5, 0.0, 0.0 } } },
    { "values of both zeros", { { 0.0, 0.0, 0.0, -0.0 }, { 1.0, 0.0, 0.0, 0.0 } }, 0.0, {} },
    { "a difference that overflows", { { 0.0, 0.0, 0.0, -largest }, { 1.0, 0.0, 0.0, largest } },
      0.0, { { 0.5, 0.0, 0.0 } } },
    { "collinear samples", line, 0.5, crossings },
  };
  for (const Case& few : cases)
  {
    SCOPED_TRACE(few.name);
    const Surface surface = contour(few.samples, few.isovalue);
    std::vector<Vector> points;
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      points.push_back(surface.point(i));
    }
    std::sort(points.begin(), points.end());
    EXPECT_EQ(points, few.points);
  }
  const Surface two = contour(cases[2].samples, 1.5);
  EXPECT_EQ(two.normal(0)[0], -1.0);
  EXPECT_NEAR(two.radius(0), 2.2, 1e-6); // 1.1 times half of the edge
}

TEST(Degenerate, CloudsWithoutASurface)
{
  const Samples samples = distances(2000);
  const Samples coincident = changed(samples, [](Sample& s) { s[0] = s[1] = s[2] = 1.0; });
  const Samples constant = changed(samples, [](Sample& s) { s[3] = 5.0; });
  const std::vector<std::pair<Samples, double>> cases{ { coincident, 0.7 }, { constant, 5.0 },
    { constant, 4.9 }, { constant, 5.1 }, { samples, infinity }, { samples, -infinity },
    { samples, 1e300 }, { samples, -1e300 } };
  for (const auto& [cloud, isovalue] : cases)
  {
    const Surface surface = contour(cloud, isovalue);
    EXPECT_EQ(surface.count(), 0) << isovalue;
    EXPECT_EQ(surface.skipped, 0);
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

TEST(Degenerate, CoincidentSamplesCountAsOneWithTheMeanOfTheirValues)
{
  Samples samples = distances(20000);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    samples[i] = i % 10 == 0 ? samples[i] : Sample{ 0.0, 0.0, 0.0, i % 2 ? 0.5 : -0.5 };
  }
  expectSphere(contour(samples, 0.7), 300, 0.7, 0.1);
  EXPECT_EQ(contour(samples, -0.1).count(), 0); // the mean is about 0
  EXPECT_EQ(contour(samples, -0.5).count(), 0);
}

TEST(Degenerate, LatticesAndSamplesFarFromTheOriginHaveSpheres)
{
  expectSphere(contour(latticeOf(21, length), 7.5), 700, 7.5, 0.05);
  expectSphere(contour(scaled(distances(20000), 0.015, 1e9), 0.7), 500, 0.7, 0.03, 1e9, 0.015);
}

TEST(Degenerate, ScaledSamplesHaveTheScaledSurface)
{
  const Surface unscaled = contour(distances(3000), 0.7);
  EXPECT_GT(unscaled.count(), 200);
  for (const double scale : { 0x1p-100, 0x1p-30, 0x1p30, 0x1p100 })
  {
    SCOPED_TRACE(scale);
    const Surface surface = contour(scaled(distances(3000), scale), 0.7);
    ASSERT_EQ(surface.count(), unscaled.count());
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      ASSERT_EQ(surface.point(i), scale * unscaled.point(i));
      ASSERT_LT(length(surface.normal(i) - unscaled.normal(i)), 1e-5);
      ASSERT_FLOAT_EQ(
        static_cast<float>(surface.radius(i) / scale), static_cast<float>(unscaled.radius(i)));
    }
  }
}

TEST(Degenerate, SurfacesAreFiniteNearTheLimitsOfDouble)
{
  // Coordinates of few significant bits, and close to the largest double.
  for (const double scale : { 1e-320, 1e-310, 1e-200, 1e150, 1e300 })
  {
    expectSphere(contour(scaled(distances(500), scale), 0.7), 20, 0.5, 0.5, 0.0, scale);
  }
  // Coordinates whose squares underflow, and curvatures that overflow.
  const Samples lattice =
    changed(latticeOf(9, length), [](Sample& s) { s[3] = std::round(2.0 * s[3]); });
  for (const double scale : { 1e-152, 1e-153, 1e-154, 1e-155 })
  {
    EXPECT_GT(contour(scaled(lattice, scale), 5.0).count(), 100) << scale;
  }
  // Fits that move points beyond samples at the largest double.
  const Samples bent = latticeOf(
    5, [](const Vector& p) { return 0.5 * p[0] + 0.075 * p[0] * p[0] + 0.075 * p[0] * p[1]; });
  const double half = 0.5 * std::numeric_limits<double>::max();
  EXPECT_GT(contour(scaled(bent, half), 1.55).count(), 5);
}

TEST(Degenerate, SamplesThatAreNotFiniteAreLeftOutAndCounted)
{
  const Samples finite = distances(2000);
  Samples all;
  for (const Sample& sample : finite)
  {
    all.push_back(sample);
    if (all.size() % 4 == 0)
    {
      all.push_back(sample);
      all.back()[all.size() / 5 % 4] =
        Vector{ notANumber, infinity, -infinity }[all.size() / 20 % 3];
    }
  }
  const Surface surface = contour(all, 0.7);
  EXPECT_EQ(surface.skipped, static_cast<vtkIdType>(all.size() - finite.size()));
  EXPECT_GT(surface.count(), 100);
  EXPECT_EQ(pointsOf(surface.output), pointsOf(contour(finite, 0.7).output));

  const Surface none = contour(changed(finite, [](Sample& s) { s[1] = notANumber; }), 0.7);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.skipped, 2000);
}

// Gradients that overflow or are denormal do not determine normals.
TEST(Degenerate, NormalsAreRightWhereGradientsOverflowOrUnderflow)
{
  const std::vector<std::array<double, 2>> scales{ { 1e30, 1e-300 }, { 1e-20, 1e300 },
    { 1e-5, 1e303 }, { 1.5e-6, 1e302 } };
  for (const auto& [size, slope] : scales)
  {
    SCOPED_TRACE(size);
    const Surface surface = contour(changed(scaled(distances(3000), size),
                                      [slope = slope](Sample& s) { s[3] = slope * (s[3] - 0.7); }),
      0.0);
    EXPECT_GT(surface.count(), 200);
    for (vtkIdType i = 0; i < surface.count(); ++i)
    {
      const Vector direction = 1.0 / size * surface.point(i);
      ASSERT_LT(dot(surface.normal(i), direction) / length(direction), -0.5);
    }
  }
}

TEST(Degenerate, IntegersThatDoubleCannotRepresentAreRounded)
{
  expectRoundedToDouble<vtkLongLongArray>((1LL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkLongLongArray>(-(1LL << 53) - 1001, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 53) + 1, 100.0);
  expectRoundedToDouble<vtkUnsignedLongLongArray>((1ULL << 62) + (1ULL << 61), 1e6);
}
