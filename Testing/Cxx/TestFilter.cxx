// SPDX-License-Identifier: GPL-3.0-or-later
// The output of an update: points, conventions, order, precision; the same for any number of
// threads.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkScatteredIsosurfaceFilter.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace filtertesting;

TEST(Filter, OutputFollowsTheConventions)
{
  const auto cloud = newCloud(20000);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  filter->SetValue(0, 0.7);
  filter->Update();
  vtkPolyData* const output = filter->GetOutput();
  const vtkIdType count = output->GetNumberOfPoints();
  ASSERT_GT(count, 1000);
  EXPECT_EQ(output->GetNumberOfVerts(), count);
  EXPECT_EQ(output->GetNumberOfCells(), count);
  EXPECT_EQ(output->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);

  vtkPointData* const data = output->GetPointData();
  ASSERT_TRUE(data->GetScalars());
  EXPECT_STREQ(data->GetScalars()->GetName(), "distance");
  ASSERT_TRUE(vtkFloatArray::SafeDownCast(data->GetNormals()));
  EXPECT_STREQ(data->GetNormals()->GetName(), "Normals");
  ASSERT_TRUE(vtkFloatArray::SafeDownCast(data->GetArray("Radius")));
  vtkDataArray* const position = data->GetArray("position");
  ASSERT_TRUE(position && data->GetArray("x"));
  ASSERT_EQ(position->GetNumberOfComponents(), 3);

  for (vtkIdType i = 0; i < count; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    output->GetVerts()->GetCellAtId(i, size, ids);
    ASSERT_TRUE(size == 1 && ids[0] == i);
    ASSERT_EQ(data->GetScalars()->GetComponent(i, 0), 0.7);
    double p[3];
    output->GetPoint(i, p);
    const double r = std::hypot(p[0], p[1], p[2]);
    ASSERT_NEAR(r, 0.7, 0.03);
    double outwards = 0.0; // along the normal
    for (int axis = 0; axis < 3; ++axis)
    {
      outwards -= data->GetNormals()->GetComponent(i, axis) * p[axis] / r;
    }
    ASSERT_GT(outwards, 0.95);
    ASSERT_EQ(data->GetArray("x")->GetComponent(i, 0), position->GetComponent(i, 0));
    ASSERT_GE(data->GetArray("Radius")->GetComponent(i, 0), 0.0);
  }
}

TEST(Filter, SeveralIsovaluesAreOrderedAndRepeatedOnesCountOnce)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(5000));
  std::vector<double> expected;
  std::vector<double> isovalues;
  for (const double isovalue : { 0.4, 0.6, 0.8 })
  {
    filter->SetNumberOfContours(1);
    filter->SetValue(0, isovalue);
    filter->Update();
    const std::vector<double> points = pointsOf(filter->GetOutput());
    expected.insert(expected.end(), points.begin(), points.end());
    isovalues.insert(isovalues.end(), points.size() / 3, isovalue);
  }
  EXPECT_FALSE(expected.empty());
  filter->SetNumberOfContours(4);
  filter->SetValue(0, 0.8);
  filter->SetValue(1, 0.4);
  filter->SetValue(2, 0.6);
  filter->SetValue(3, 0.8);
  filter->Update();
  EXPECT_EQ(pointsOf(filter->GetOutput()), expected);
  for (std::size_t i = 0; i < isovalues.size(); ++i)
  {
    ASSERT_EQ(
      filter->GetOutput()->GetPointData()->GetScalars()->GetComponent(static_cast<vtkIdType>(i), 0),
      isovalues[i]);
  }
  filter->GenerateValues(3, 0.4, 0.8);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfContours(), 3);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints() * 3, static_cast<vtkIdType>(expected.size()));
}

TEST(Filter, PrecisionOfThePoints)
{
  for (const int inputType : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(newCloud(500, inputType));
    filter->SetValue(0, 0.7);
    const int types[3] = { VTK_FLOAT, VTK_DOUBLE, inputType };
    for (const int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION,
           vtkAlgorithm::DEFAULT_PRECISION })
    {
      filter->SetOutputPointsPrecision(precision);
      filter->Update();
      EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), types[precision]);
    }
  }
}

TEST(Filter, AnIsovalueOutOfRangeYieldsAnEmptyOutputWithAllArrays)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(500));
  const auto errors = watchErrors(filter);
  filter->SetValue(0, 99.0);
  filter->Update();
  expectEmpty(filter->GetOutput());
  for (const char* const name : { "distance", "x", "position", "Normals", "Radius" })
  {
    EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray(name)) << name;
  }
  EXPECT_EQ(errors->Count, 0);
}

TEST(Filter, EveryDataSetOfTheSamePointsYieldsTheSame)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(12, 13, 14);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(0.17, 0.16, 0.15);
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(12, 13, 14);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    for (int i = 0; i < image->GetDimensions()[axis]; ++i)
    {
      coordinates->InsertNextValue(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
    }
    axis == 0   ? rectilinear->SetXCoordinates(coordinates)
    : axis == 1 ? rectilinear->SetYCoordinates(coordinates)
                : rectilinear->SetZCoordinates(coordinates);
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto scalars = newArray("f", image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    points->InsertNextPoint(p);
    scalars->SetValue(i, static_cast<float>(p[0] * p[0] + p[1] + 0.3 * p[2]));
  }
  vtkNew<vtkPolyData> polyData;
  polyData->SetPoints(points);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);

  std::vector<double> expected;
  for (vtkDataSet* const input :
    std::initializer_list<vtkDataSet*>{ image, rectilinear, polyData, grid })
  {
    SCOPED_TRACE(input->GetClassName());
    input->GetPointData()->SetScalars(scalars);
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(input);
    filter->SetValue(0, 0.3);
    filter->Update();
    const std::vector<double> found = pointsOf(filter->GetOutput());
    EXPECT_FALSE(found.empty());
    if (expected.empty())
    {
      expected = found;
    }
    EXPECT_EQ(found, expected);
  }
}

namespace
{

/// All numbers of an output.
std::vector<double> everythingOf(vtkPolyData* output)
{
  std::vector<double> everything = pointsOf(output);
  const auto add = [&everything](vtkDataArray* array)
  {
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      everything.push_back(array->GetVariantValue(i).ToDouble());
    }
  };
  for (int i = 0; i < output->GetPointData()->GetNumberOfArrays(); ++i)
  {
    add(output->GetPointData()->GetArray(i));
  }
  add(output->GetVerts()->GetConnectivityArray());
  add(output->GetPolys()->GetConnectivityArray());
  return everything;
}

/// Expects an output of a filter with all arrays that is the same for any threads.
void expectSameBytes(vtkScatteredContourFilter* filter)
{
  filter->ComputeGradientsOn();
  filter->ComputeProjectionOrdersOn();
  filter->SetValue(0, 0.7);
  std::vector<double> expected;
  const std::string former = vtkSMPTools::GetBackend();
  for (const char* const backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue; // not built into this VTK
    }
    vtkSMPTools::SetBackend(former.c_str());
    for (const int threads : { 1, 2, 4 })
    {
      for (const bool useAllCores : { false, true })
      {
        vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, backend, false },
          [&]()
          {
            filter->SetUseAllCores(useAllCores);
            filter->Modified();
            filter->Update();
            const std::vector<double> found = everythingOf(filter->GetOutput());
            expected = expected.empty() ? found : expected;
            EXPECT_TRUE(found == expected) << backend << " " << threads;
          });
      }
    }
  }
  EXPECT_FALSE(expected.empty());
}

} // namespace

TEST(Filter, SameBytesForAnyBackendAndNumberOfThreads)
{
  const auto cloud = newCloud(150000);
  vtkNew<vtkScatteredIsopointFilter> points;
  vtkNew<vtkScatteredIsosurfaceFilter> triangles;
  for (vtkScatteredContourFilter* const filter : { static_cast<vtkScatteredContourFilter*>(points),
         static_cast<vtkScatteredContourFilter*>(triangles) })
  {
    SCOPED_TRACE(filter->GetClassName());
    filter->SetInputData(cloud);
    filter->KeepTreeOff();
    expectSameBytes(filter);
  }
}
