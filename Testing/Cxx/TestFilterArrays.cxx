// SPDX-License-Identifier: GPL-3.0-or-later
// Which arrays the output has, and their values.
#include "FilterTesting.h"

#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace filtertesting;

TEST(FilterArrays, OutputsCanBeSwitchedOff)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(3000));
  filter->SetValue(0, 0.7);
  filter->ComputeNormalsOff();
  filter->ComputeSplatsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  vtkPointData* const data = filter->GetOutput()->GetPointData();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_FALSE(data->GetNormals() || data->GetArray("Radius") || data->GetArray("distance"));
  EXPECT_TRUE(data->GetArray("x"));
}

// Rounding is an error of values, not detail: normals on stairs of integers are those of what was
// rounded.
TEST(FilterArrays, IntegersAreRoundedValues)
{
  constexpr vtkIdType count = 20000;
  const auto cloud = newCloud(count);
  vtkDataArray* const distance = cloud->GetPointData()->GetArray("distance");
  const auto integers = newArray<vtkIntArray>("integers", count);
  const auto numbers = newArray<vtkDoubleArray>("numbers", count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    numbers->SetValue(i, std::round(20.0 * distance->GetComponent(i, 0)));
    integers->SetValue(i, static_cast<int>(numbers->GetValue(i)));
  }
  cloud->GetPointData()->AddArray(integers);
  cloud->GetPointData()->AddArray(numbers);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 14.3);
  const auto meanSine = [&filter](const char* name)
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    filter->Update();
    vtkPolyData* const isopoints = filter->GetOutput();
    double sum = 0.0;
    for (vtkIdType i = 0; i < isopoints->GetNumberOfPoints(); ++i)
    {
      double p[3];
      double normal[3];
      isopoints->GetPoint(i, p);
      isopoints->GetPointData()->GetNormals()->GetTuple(i, normal);
      const double along = vtkMath::Dot(p, normal) / vtkMath::Norm(p);
      sum += std::sqrt(std::max(0.0, 1.0 - along * along));
    }
    return sum / static_cast<double>(isopoints->GetNumberOfPoints());
  };
  const double exact = meanSine("numbers");
  EXPECT_LT(meanSine("integers"), 0.7 * exact);
  EXPECT_EQ(meanSine("numbers"), exact); // nothing is left of the error of the integers
}

TEST(FilterArrays, ScalarsOfAnyType)
{
  for (const int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_FLOAT, VTK_DOUBLE, VTK_ID_TYPE })
  {
    SCOPED_TRACE(type);
    const auto cloud = newCloud(4000);
    vtkDataArray* const distance = cloud->GetPointData()->GetArray("distance");
    const auto typed = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    typed->SetName("typed");
    typed->SetNumberOfTuples(4000);
    for (vtkIdType i = 0; i < 4000; ++i)
    {
      typed->SetComponent(i, 0, std::floor(60.0 * distance->GetComponent(i, 0)));
    }
    cloud->GetPointData()->AddArray(typed);
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(cloud);
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "typed");
    filter->SetValue(0, 42.5);
    filter->Update();
    ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 100);
    vtkDataArray* const contoured = filter->GetOutput()->GetPointData()->GetArray("typed");
    EXPECT_EQ(contoured->GetDataType(), type == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
    EXPECT_EQ(contoured->GetComponent(0, 0), 42.5);
    double p[3];
    filter->GetOutput()->GetPoint(0, p);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 0.71, 0.05);
  }
}

TEST(FilterArrays, NumbersAreInterpolatedAndOtherArraysCopied)
{
  vtkNew<vtkPolyData> pair;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  pair->SetPoints(points);
  const auto f = newArray("f", 3);
  const auto whole = newArray<vtkIntArray>("whole", 3);
  const auto ids = newArray<vtkIdTypeArray>("pedigree", 3);
  const auto globalIds = newArray<vtkIdTypeArray>("global", 3);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  const float values[3] = { 0.0f, 3.0f, 5.0f }; // the coincident two count as 4
  for (int i = 0; i < 3; ++i)
  {
    f->SetValue(i, values[i]);
    whole->SetValue(i, 10 * i);
    ids->SetValue(i, 100 + i);
    globalIds->SetValue(i, i);
    names->InsertNextValue(std::string(1, static_cast<char>('a' + i)));
  }
  vtkPointData* const input = pair->GetPointData();
  input->SetScalars(f);
  input->AddArray(whole);
  input->SetPedigreeIds(ids);
  input->SetGlobalIds(globalIds);
  input->AddArray(names);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(pair);
  filter->SetValue(0, 3.0);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 1);
  vtkPointData* const output = filter->GetOutput()->GetPointData();
  EXPECT_EQ(filter->GetOutput()->GetPoint(0)[0], 0.75);
  EXPECT_EQ(output->GetArray("whole")->GetComponent(0, 0), 11); // 0.75 * (10 + 20) / 2, rounded
  ASSERT_TRUE(output->GetPedigreeIds());
  EXPECT_EQ(output->GetPedigreeIds()->GetVariantValue(0).ToInt(), 101);
  EXPECT_FALSE(output->GetGlobalIds());
  auto* const outputNames = vtkStringArray::SafeDownCast(output->GetAbstractArray("names"));
  ASSERT_TRUE(outputNames);
  EXPECT_EQ(outputNames->GetValue(0), "b");
}

TEST(FilterArrays, GhostsAndSamplesThatAreNotFiniteAreLeftOut)
{
  const auto cloud = newCloud(2000);
  vtkNew<vtkPoints> points;
  points->DeepCopy(cloud->GetPoints());
  cloud->SetPoints(points);
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), 2000);
  ghosts->Fill(0);
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATEPOINT);
  ghosts->SetValue(4, vtkDataSetAttributes::HIDDENPOINT);
  cloud->GetPointData()->AddArray(ghosts);
  points->SetPoint(5, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  cloud->GetPointData()->GetScalars()->SetComponent(6, 0, std::numeric_limits<double>::infinity());
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 4);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_FALSE(
    filter->GetOutput()->GetPointData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
}

TEST(FilterArrays, ArraysOfAnotherLengthAreLeftOut)
{
  const auto cloud = newCloud(500);
  cloud->GetPointData()->AddArray(newArray("short", 5));
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto errors = watchErrors(filter);
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("short"));
  EXPECT_EQ(errors->Count, 0);
}

TEST(FilterArrays, AComputedArrayThatReplacesAnInputArrayIsWarnedOf)
{
  const auto cloud = newCloud(500);
  cloud->GetPointData()->GetScalars()->SetName("Radius");
  vtkNew<vtkScatteredIsopointFilter> filter;
  const auto warnings = vtkSmartPointer<ErrorWatcher>::Take(ErrorWatcher::New());
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  filter->ComputeSplatsOff();
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Radius")->GetComponent(0, 0), 0.7);
  // Shapes of splats are arrays of the vertices, and replace none of points.
  filter->ComputeSplatsOn();
  cloud->GetPointData()->GetScalars()->SetName("SplatAxis");
  cloud->Modified();
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("SplatAxis")->GetComponent(0, 0), 0.7);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetArray("SplatAxis")->GetNumberOfComponents(), 3);
}
