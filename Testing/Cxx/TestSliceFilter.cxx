// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of slices: functions, offsets, kinds of samples, arrays, kept trees, messages.
// Testing/Python/TestDataSets.py compares its results with vtkCutter and with the C library.
#include "InputTesting.h"

#include "vtkScatteredSliceFilter.h"

#include "vtkBox.h"
#include "vtkErrorCode.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkSMPTools.h"
#include "vtkSphere.h"
#include "vtkTransform.h"
#include "vtkTypeInt64Array.h"
#include "vtkTypeUInt64Array.h"

#include <atomic>
#include <cerrno>
#include <limits>
#include <thread>

using namespace inputtesting;

namespace
{

using Slice = vtkScatteredSliceFilter;

vtkSmartPointer<vtkPlane> planeAt(double z)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(0.0, 0.0, z);
  plane->SetNormal(0.0, 0.0, 1.0);
  return plane;
}

vtkSmartPointer<Slice> sliceOf(vtkDataObject* samples, vtkImplicitFunction* function)
{
  auto filter = vtkSmartPointer<Slice>::New();
  filter->SetInputDataObject(samples);
  filter->SetCutFunction(function);
  return filter;
}

std::vector<double> sliced(vtkDataObject* samples, vtkImplicitFunction* function)
{
  return everythingOf(updated(sliceOf(samples, function)));
}

} // namespace

TEST(SliceFilter, SamplesOfEveryKindAreOneCloud)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 2.0, 3.0);
  forEachGridAndCloud(
    [&](vtkDataSet* samples, vtkPolyData* cloud)
    {
      plane->SetOrigin(samples->GetCenter());
      const auto filter = sliceOf(samples, plane);
      filter->SetOutputPointsPrecision(Slice::DOUBLE_PRECISION);
      const std::vector<double> all = everythingOf(updated(filter));
      EXPECT_GT(all.size(), 100u);
      EXPECT_EQ(all, sliced(cloud, plane));
    });
  const auto cloud = newCloud(2000, VTK_DOUBLE);
  const auto blocks = blocksOf({ everyNth(cloud, 0, 2), nullptr, everyNth(cloud, 1, 2) });
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(0.6);
  const auto level = planeAt(0.1);
  for (vtkImplicitFunction* const function :
    std::initializer_list<vtkImplicitFunction*>{ level, sphere })
  {
    // The order of samples matters only for the order of points.
    EXPECT_EQ(updated(sliceOf(blocks, function))->GetNumberOfPoints(),
      updated(sliceOf(cloud, function))->GetNumberOfPoints());
  }
  const auto filter = sliceOf(newCloudWithGhosts(1002, 1000), planeAt(0.0));
  updated(filter);
  EXPECT_EQ(filter->GetNumberOfSamples(), 1002);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 2);
}

TEST(SliceFilter, PointsAreOnTheFunction)
{
  const auto cloud = newCloud(4000, VTK_DOUBLE);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.48, 0.6, 0.64);
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(0.6);
  vtkNew<vtkBox> box;
  box->SetBounds(-0.5, 0.5, -0.6, 0.6, -0.7, 0.7);
  vtkNew<vtkPlane> turned;
  vtkNew<vtkTransform> transform;
  transform->RotateX(30.0);
  turned->SetTransform(transform);
  for (vtkImplicitFunction* const function :
    std::initializer_list<vtkImplicitFunction*>{ plane, sphere, box, turned })
  {
    for (const int interpolation : { Slice::FITS, Slice::LINEAR })
    {
      const auto filter = sliceOf(cloud, function);
      filter->SetInterpolation(interpolation);
      filter->SetNumberOfContours(2);
      filter->SetValue(1, 0.1);
      vtkPolyData* const output = updated(filter);
      EXPECT_EQ(output->GetNumberOfPoints(), filter->GetNumberOfExtractedPoints());
      std::array<vtkIdType, 2> counts{};
      vtkDataArray* const position = output->GetPointData()->GetArray("position");
      for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
      {
        const Vector p = placeOf(output, i);
        const double value = function->FunctionValue(p.data());
        ++counts.at(value < 0.05 ? 0 : 1);
        EXPECT_NEAR(value, value < 0.05 ? 0.0 : 0.1, 1e-13);
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_NEAR(position->GetComponent(i, axis), p[static_cast<std::size_t>(axis)], 1e-6);
        }
      }
      EXPECT_GT(std::min(counts[0], counts[1]), 150);
    }
  }
}

TEST(SliceFilter, KeepsTypesIdsAndTexts)
{
  const auto cloud = newCloud(3000);
  vtkPointData* const samples = cloud->GetPointData();
  samples->AddArray(arrayOf<vtkUnsignedCharArray>(
    "byte", 3000, [&](vtkIdType i) { return std::round(127.0 + 100.0 * placeOf(cloud, i)[0]); }));
  samples->SetPedigreeIds(arrayOf<vtkIdTypeArray>("ids", 3000, [](vtkIdType i) { return 7 * i; }));
  samples->AddArray(textsOf("text", 3000, [](vtkIdType i) { return std::to_string(7 * i); }));
  samples->AddArray(setScalars(
    cloud, [](const Vector& p) { return p[1]; }, "with a hole"));
  vtkDoubleArray::SafeDownCast(samples->GetArray("with a hole"))->SetValue(0, notANumber);
  const auto filter = sliceOf(cloud, planeAt(0.2));
  vtkPolyData* const output = updated(filter);
  vtkPointData* const arrays = output->GetPointData();
  EXPECT_EQ(arrays->GetNumberOfArrays(), samples->GetNumberOfArrays());
  EXPECT_EQ(arrays->GetArray("x")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(arrays->GetArray("byte")->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_STREQ(arrays->GetPedigreeIds()->GetName(), "ids");
  auto* const texts = vtkStringArray::SafeDownCast(arrays->GetAbstractArray("text"));
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const Vector p = placeOf(output, i);
    EXPECT_NEAR(arrays->GetArray("byte")->GetComponent(i, 0), 127.0 + 100.0 * p[0], 1.0);
    EXPECT_NEAR(arrays->GetArray("with a hole")->GetComponent(i, 0), p[1], 1e-6);
    const double id = arrays->GetArray("ids")->GetComponent(i, 0);
    EXPECT_EQ(texts->GetValue(i), std::to_string(static_cast<vtkIdType>(id)));
    const Vector sample = placeOf(cloud, static_cast<vtkIdType>(id) / 7);
    EXPECT_LT(length({ sample[0] - p[0], sample[1] - p[1], sample[2] - p[2] }), 1.0);
  }
}

/// Those of 64 bits exceed their range when they are rounded to double.
TEST(SliceFilter, LargestIntegersStay)
{
  const auto cloud = newCloud(1000);
  const auto most = newArray<vtkTypeInt64Array>("most", 1000);
  most->FillValue(std::numeric_limits<vtkTypeInt64>::max());
  const auto all = newArray<vtkTypeUInt64Array>("all", 1000);
  all->FillValue(std::numeric_limits<vtkTypeUInt64>::max());
  const auto byte = newArray<vtkUnsignedCharArray>("byte", 1000);
  byte->FillValue(255);
  for (vtkDataArray* const array : std::initializer_list<vtkDataArray*>{ most, all, byte })
  {
    cloud->GetPointData()->AddArray(array);
  }
  const auto plane = planeAt(0.0);
  vtkNew<vtkSphere> sphere;
  for (vtkImplicitFunction* const function :
    std::initializer_list<vtkImplicitFunction*>{ plane, sphere })
  {
    for (const int interpolation : { Slice::FITS, Slice::LINEAR })
    {
      const auto filter = sliceOf(cloud, function);
      filter->SetInterpolation(interpolation);
      vtkPolyData* const output = updated(filter);
      ASSERT_GT(output->GetNumberOfPoints(), 50);
      for (vtkDataArray* const array : std::initializer_list<vtkDataArray*>{ most, all, byte })
      {
        vtkDataArray* const found = output->GetPointData()->GetArray(array->GetName());
        for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
        {
          ASSERT_EQ(found->GetVariantValue(i), array->GetVariantValue(0)) << array->GetName();
        }
      }
    }
  }
}

TEST(SliceFilter, NearestSamplesKeepNumbersOfMaterials)
{
  constexpr vtkTypeInt64 large = (vtkTypeInt64{ 1 } << 53) + 1; // not held by double
  const auto cloud = newCloud(2000, VTK_DOUBLE);
  cloud->GetPointData()->AddArray(arrayOf<vtkTypeInt64Array>(
    "material", 2000, [&](vtkIdType i) { return placeOf(cloud, i)[0] < 0.0 ? 3 : large; }));
  const auto plane = planeAt(0.0);
  vtkNew<vtkSphere> sphere;
  for (vtkImplicitFunction* const function :
    std::initializer_list<vtkImplicitFunction*>{ plane, sphere })
  {
    const auto filter = sliceOf(cloud, function);
    filter->SetInterpolation(Slice::NEAREST);
    vtkPolyData* const output = updated(filter);
    auto* const found =
      vtkTypeInt64Array::SafeDownCast(output->GetPointData()->GetArray("material"));
    vtkDataArray* const position = output->GetPointData()->GetArray("position");
    ASSERT_GT(found->GetNumberOfTuples(), 100);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      ASSERT_EQ(found->GetValue(i), position->GetComponent(i, 0) < 0.0 ? 3 : large);
    }
  }
}

/// A function that may not be for threads, as it is of no class that is known.
class CountingSphere : public vtkSphere
{
public:
  static CountingSphere* New();
  vtkTypeMacro(CountingSphere, vtkSphere);
  using vtkSphere::EvaluateFunction;
  double EvaluateFunction(double place[3]) override
  {
    this->Elsewhere += std::this_thread::get_id() == this->Creator ? 0 : 1;
    return this->vtkSphere::EvaluateFunction(place);
  }

  const std::thread::id Creator = std::this_thread::get_id();
  std::atomic<int> Elsewhere{ 0 };
};
vtkStandardNewMacro(CountingSphere);

TEST(SliceFilter, OnlyKnownFunctionsAreEvaluatedByThreads)
{
  const auto cloud = newCloud(20000);
  vtkNew<CountingSphere> counting;
  vtkNew<vtkSphere> sphere;
  const std::vector<double> expected = sliced(cloud, sphere);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 3, "STDThread", false },
    [&]()
    {
      EXPECT_EQ(sliced(cloud, sphere), expected);
      EXPECT_EQ(sliced(cloud, counting), expected);
    });
  EXPECT_EQ(counting->Elsewhere, 0);
}

TEST(SliceFilter, NoNameOfAnArrayIsReserved)
{
  const auto cloud = newCloud(1000);
  cloud->GetPointData()->AddArray(arrayOf<vtkDoubleArray>(
    "vtkIsopointPositions", 1000, [&](vtkIdType i) { return placeOf(cloud, i)[1]; }));
  vtkNew<vtkSphere> sphere;
  const auto filter = sliceOf(cloud, sphere);
  vtkPolyData* const output = updated(filter);
  vtkDataArray* const found = output->GetPointData()->GetArray("vtkIsopointPositions");
  ASSERT_TRUE(found);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(found->GetComponent(i, 0), placeOf(output, i)[1], 1e-6);
  }
}

/// Each result is that of a new filter, whatever was kept.
TEST(SliceFilter, FollowsFunctionOffsetsAndSamples)
{
  const auto cloud = newCloud(3000, VTK_DOUBLE);
  const auto plane = planeAt(0.0);
  const auto filter = sliceOf(cloud, plane);
  const auto expectNew = [&]()
  {
    const auto fresh = sliceOf(cloud, filter->GetCutFunction());
    fresh->SetValue(0, filter->GetValue(0));
    expectAsNew(filter, fresh, 1000);
  };
  expectNew();
  plane->SetOrigin(0.3, 0.2, 0.1); // along the normal
  expectNew();
  plane->SetNormal(1.0, 1.0, 0.0);
  expectNew();
  filter->SetValue(0, 0.2);
  expectNew();
  vtkNew<vtkSphere> sphere;
  filter->SetCutFunction(sphere);
  expectNew();
  sphere->SetRadius(0.7);
  expectNew();
  filter->KeepTreeOff();
  filter->SetCutFunction(plane);
  expectNew();
  filter->KeepTreeOn();
  expectNew();
  distancesOf(cloud)->FillValue(1.0);
  distancesOf(cloud)->Modified();
  expectNew();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("distance")->GetRange()[1], 1.0);
  move(cloud->GetPoints(), [](const Vector& p) { return Vector{ p[0], p[1], 0.9 * p[2] }; });
  cloud->GetPoints()->Modified();
  expectNew();
}

TEST(SliceFilter, EndsAtTheHullAndInVoids)
{
  const auto areaOf = [](vtkPolyData* surface)
  {
    double area = 0.0;
    for (const auto& [a, b, c] : trianglesOf(surface))
    {
      const Vector p = placeOf(surface, a);
      const Vector q = placeOf(surface, b);
      const Vector r = placeOf(surface, c);
      area += 0.5 * std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    }
    return area;
  };
  const auto cloud = newCloud(40000);
  EXPECT_NEAR(areaOf(updated(sliceOf(cloud, planeAt(0.3)))), 4.0, 0.04);
  Samples shell;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    const Vector p = placeOf(cloud, i);
    if (length(p) > 0.5)
    {
      shell.push_back({ p[0], p[1], p[2], 0.0 });
    }
  }
  const auto filter = sliceOf(cloudOf(shell), planeAt(0.0));
  constexpr double pi = 3.14159265358979;
  const double spacing = 2.0 * std::pow(40000.0, -1.0 / 3.0);
  EXPECT_NEAR(areaOf(updated(filter)), 4.0 - 0.25 * pi, pi * spacing); // a spacing around the void
  filter->DropGapsOff();
  EXPECT_NEAR(areaOf(updated(filter)), 4.0, 0.04);
}

TEST(SliceFilter, MessagesNameTheCause)
{
  const auto cloud = newCloud(1000);
  const auto expectError = [](Slice* filter, const std::string& text)
  {
    const auto errors = watchErrors(filter);
    filter->Update();
    EXPECT_EQ(errors->count(), 1u);
    expectContains(errors->last(), text);
    EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(EINVAL));
    expectEmpty(filter->GetOutput());
  };
  const auto filter = sliceOf(cloud, nullptr);
  expectError(filter, "no cut function");
  filter->SetCutFunction(planeAt(0.0));
  filter->SetValue(0, notANumber);
  expectError(filter, "not a number");
  filter->SetValue(0, 5.0);
  const auto warnings = watchMessages(filter, vtkCommand::WarningEvent);
  expectEmpty(updated(filter));
  expectContains(warnings->last(), "all samples are on one side");
  filter->SetValue(0, 0.0);
  EXPECT_GT(updated(filter)->GetNumberOfPoints(), 100);
  expectError(sliceOf(vtkSmartPointer<vtkPolyData>::New(), planeAt(0.0)), "no points or cells");
  // Without arrays a slice has its shape.
  vtkNew<vtkPolyData> bare;
  bare->SetPoints(cloud->GetPoints());
  EXPECT_EQ(updated(sliceOf(bare, planeAt(0.0)))->GetNumberOfPoints(),
    updated(sliceOf(cloud, planeAt(0.0)))->GetNumberOfPoints());
}
