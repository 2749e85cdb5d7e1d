// SPDX-License-Identifier: GPL-3.0-or-later
// The filter's promises, from C++.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

using namespace filtertesting;

TEST(Filter, OutputIsWhatTheConventionsSay)
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
    double falling = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      falling -= data->GetNormals()->GetComponent(i, axis) * p[axis] / r;
    }
    ASSERT_GT(falling, 0.95);
    ASSERT_EQ(data->GetArray("x")->GetComponent(i, 0), position->GetComponent(i, 0));
    ASSERT_GT(data->GetArray("Radius")->GetComponent(i, 0), 0.0);
  }
}

// A moved point has the attributes of the nearest place on its edge.
TEST(Filter, ProjectionMovesPointsAndTheirAttributes)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(20000));
  filter->SetValue(0, 0.7);
  filter->ComputeProjectionOrdersOn();
  filter->ComputeGradientsOn();
  std::vector<std::vector<double>> placed;
  std::vector<double> deviations;
  for (const int projection :
    { vtkScatteredIsopointFilter::NO_PROJECTION, vtkScatteredIsopointFilter::LINEAR_FIT,
      vtkScatteredIsopointFilter::QUADRATIC_FIT, vtkScatteredIsopointFilter::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    filter->Update();
    vtkPolyData* const output = filter->GetOutput();
    placed.push_back(pointsOf(output));
    vtkDataArray* const orders = output->GetPointData()->GetArray("ProjectionOrder");
    vtkDataArray* const position = output->GetPointData()->GetArray("position");
    vtkDataArray* const gradients = output->GetPointData()->GetArray("Gradients");
    ASSERT_TRUE(orders && gradients);
    double deviation = 0.0;
    vtkIdType unprojected = 0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      double p[3];
      double onEdge[3];
      double gradient[3];
      output->GetPoint(i, p);
      position->GetTuple(i, onEdge);
      gradients->GetTuple(i, gradient);
      const double* const still = placed[0].data() + 3 * i;
      const auto distance = [](const double* a, const double* b)
      { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); };
      ASSERT_LE(distance(p, onEdge), distance(p, still) + 1e-6);
      deviation = std::max(deviation, std::abs(std::hypot(p[0], p[1], p[2]) - 0.7));
      unprojected += orders->GetComponent(i, 0) == 0.0 ? 1 : 0;
      ASSERT_LE(orders->GetComponent(i, 0), projection);
      if (orders->GetComponent(i, 0) > 0.0)
      {
        ASSERT_NEAR(std::hypot(gradient[0], gradient[1], gradient[2]), 1.0, 0.1);
      }
      ASSERT_EQ(output->GetPointData()->GetScalars()->GetComponent(i, 0), 0.7);
    }
    EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), unprojected);
    deviations.push_back(deviation);
  }
  ASSERT_EQ(placed[0].size(), placed[2].size());
  EXPECT_NE(placed[0], placed[1]);
  EXPECT_LT(deviations[2], 0.1 * deviations[0]);
}

TEST(Filter, SplatArraysAreThereWhenAskedFor)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(5000));
  filter->SetValue(0, 0.7);
  filter->Update();
  for (const char* const name : { "SplatAxis1", "SplatAxis2", "SplatClip", "Gradients" })
  {
    EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray(name)) << name;
  }
  filter->ComputeSplatAxesOn();
  filter->ComputeSplatClipsOn();
  for (const int method : { vtkScatteredIsopointFilter::NORMALS_FROM_FIELD,
         vtkScatteredIsopointFilter::NORMALS_FROM_PLANES })
  {
    filter->SetNormalMethod(method);
    filter->Update();
    vtkPointData* const data = filter->GetOutput()->GetPointData();
    ASSERT_TRUE(data->HasArray("SplatClip"));
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
    {
      double a[3];
      double b[3];
      double p[3];
      data->GetArray("SplatAxis1")->GetTuple(i, a);
      data->GetArray("SplatAxis2")->GetTuple(i, b);
      filter->GetOutput()->GetPoint(i, p);
      ASSERT_NEAR(std::hypot(a[0], a[1], a[2]), data->GetArray("Radius")->GetComponent(i, 0), 1e-6);
      const double outwards = (a[1] * b[2] - a[2] * b[1]) * p[0] +
                              (a[2] * b[0] - a[0] * b[2]) * p[1] +
                              (a[0] * b[1] - a[1] * b[0]) * p[2];
      ASSERT_LT(outwards, 0.0); // distances fall inwards
    }
  }
}

/// Samples with a spacing of 1 whose scalars are 0 on a cube around a center.
vtkSmartPointer<vtkPolyData> newCubeCloud(const std::array<double, 3>& center)
{
  const auto cloud = newCloud(64000, VTK_DOUBLE);
  const auto height = newArray<vtkDoubleArray>("height", cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = 20.0 * p[axis] + center[axis];
      largest = std::max(largest, std::abs(p[axis] - center[axis]));
    }
    cloud->GetPoints()->SetPoint(i, p);
    height->SetValue(i, 12.0 - largest);
  }
  cloud->GetPointData()->SetScalars(height);
  return cloud;
}

/// Whether a splat's plane is the tangent plane of another point, or goes through its own point
/// where that lies beyond; or is a hundredth of a spacing, up to two here, farther off if no crease
/// was fitted at its own point.
bool endsAtAnother(vtkPolyData* points, vtkIdType point, const double* clip)
{
  const bool isBesideCrease =
    points->GetPointData()->GetArray("ProjectionOrder")->GetComponent(point, 0) ==
    vtkScatteredIsopointFilter::CREASE_FIT;
  const double most = isBesideCrease ? 0.0 : 0.02;
  double center[3];
  points->GetPoint(point, center);
  for (vtkIdType other = 0; other < points->GetNumberOfPoints(); ++other)
  {
    double p[3];
    double normal[3];
    points->GetPoint(other, p);
    points->GetPointData()->GetNormals()->GetTuple(other, normal);
    double cosine = 0.0;
    double distance = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      cosine += clip[axis] * normal[axis];
      distance += clip[axis] * (center[axis] - p[axis]);
    }
    constexpr double tolerance = 1e-5;
    const double beyond = clip[3] - std::max(0.0, distance);
    if (std::abs(cosine) > 1.0 - 1e-6 && beyond > -tolerance && beyond < most + tolerance)
    {
      return true;
    }
  }
  return false;
}

// Far from the origin, single precision tells the coordinates to several spacings of the samples
// only.
TEST(Filter, SplatClipsAreRelativeToThePoints)
{
  for (const std::array<double, 3> center :
    { std::array<double, 3>{ 0.0, 0.0, 0.0 }, std::array<double, 3>{ 1e8, 2e8, -1e8 } })
  {
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(newCubeCloud(center));
    filter->SetValue(0, 0.0);
    filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
    filter->ComputeSplatClipsOn();
    filter->ComputeProjectionOrdersOn();
    filter->Update();
    vtkDataArray* const clips = filter->GetOutput()->GetPointData()->GetArray("SplatClip");
    int ending = 0;
    for (vtkIdType i = 0; i < clips->GetNumberOfTuples(); ++i)
    {
      double clip[5];
      clips->GetTuple(i, clip);
      ASSERT_GE(clip[3], 0.0);
      if (clip[0] != 0.0 || clip[1] != 0.0 || clip[2] != 0.0)
      {
        ASSERT_NEAR(std::hypot(clip[0], clip[1], clip[2]), 1.0, 1e-6);
        ASSERT_EQ(clip[4], -1.0); // an edge
        ASSERT_TRUE(endsAtAnother(filter->GetOutput(), i, clip)) << i;
        ending += clip[3] > 0.0 ? 1 : 0;
      }
      else
      {
        ASSERT_EQ(clip[3], 0.0);
        ASSERT_EQ(clip[4], 0.0);
      }
    }
    EXPECT_GT(ending, 500);
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

TEST(Filter, OutputsCanBeSwitchedOff)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(3000));
  filter->SetValue(0, 0.7);
  filter->ComputeNormalsOff();
  filter->ComputeRadiiOff();
  filter->ComputeScalarsOff();
  filter->Update();
  vtkPointData* const data = filter->GetOutput()->GetPointData();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_FALSE(data->GetNormals() || data->GetArray("Radius") || data->GetArray("distance"));
  EXPECT_TRUE(data->GetArray("x"));
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

TEST(Filter, AnIsovalueOutOfRangeGivesAnEmptyOutputWithAllArrays)
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

TEST(Filter, EveryDataSetGivesTheSameFromTheSamePoints)
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

TEST(Filter, ScalarsOfAnyType)
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

TEST(Filter, InterpolatesWhatCanBeAndCopiesWhatCannot)
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
  const float values[3] = { 0.0f, 3.0f, 5.0f }; // the two at one position count as 4
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

TEST(Filter, LeavesOutGhostsAndWhatIsNotFinite)
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

TEST(Filter, WrongUseIsOneClearErrorAndAnEmptyOutput)
{
  const auto cloud = newCloud(500);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->SetNumberOfValues(500);
  cloud->GetPointData()->AddArray(names);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetValue(0, 0.7);
  const auto errors = watchErrors(filter);
  const auto expectError = [&](const char* words)
  {
    errors->Count = 0;
    filter->Update();
    EXPECT_EQ(errors->Count, 1) << words;
    EXPECT_NE(errors->Last.find(words), std::string::npos) << errors->Last;
    expectEmpty(filter->GetOutput());
  };
  const auto choose = [&](const char* name)
  { filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name); };

  filter->SetInputData(cloud);
  choose("missing");
  expectError("no point array named \"missing\"");
  choose("position");
  expectError("has 3 components");
  choose("names");
  expectError("holds no numbers");
  choose("distance");
  for (const double angle : { -1.0, 180.5, std::numeric_limits<double>::quiet_NaN() })
  {
    filter->SetAngle(angle);
    expectError("within 0 and 180");
  }
  filter->SetAngle(54.7);
  for (const double factor :
    { -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    filter->SetGapFactor(factor);
    expectError("gap factor");
  }
  filter->SetGapFactor(0.0);
  filter->SetMinimumSpacing(std::numeric_limits<double>::quiet_NaN());
  expectError("minimum spacing");
  filter->SetMinimumSpacing(0.0);
  filter->SetNumberOfContours(2);
  filter->SetValue(0, std::numeric_limits<double>::quiet_NaN());
  filter->SetValue(1, 0.7);
  expectError("not a number");
  filter->SetNumberOfContours(1);
  filter->SetValue(0, 0.7);
  vtkNew<vtkPolyData> nothing;
  filter->SetInputData(nothing);
  expectError("no points");

  filter->SetInputData(cloud);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Filter, GapFactorDropsPointsInVoids)
{
  const auto cloud = newCloud(20000);
  // Cut at x = 0 and pulled apart: the gap is five times as wide as the cloud was.
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    p[0] += p[0] > 0.0 ? 10.0 : 0.0;
    cloud->GetPoints()->SetPoint(i, p);
  }
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  const auto count = [&filter](const char* array, double isovalue, double gapFactor)
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
    filter->SetValue(0, isovalue);
    filter->SetGapFactor(gapFactor);
    filter->Update();
    return static_cast<double>(filter->GetOutput()->GetNumberOfPoints());
  };
  EXPECT_GT(count("x", 0.0, 0.0), 0.0); // all in the gap
  EXPECT_EQ(count("x", 0.0, 4.0), 0.0);
  EXPECT_GT(count("distance", 0.7, 4.0), 0.95 * count("distance", 0.7, 0.0));
}

TEST(Filter, SameBytesForAnyBackendAndNumberOfThreads)
{
  const auto cloud = newCloud(150000);
  std::vector<double> expected;
  const auto everythingOf = [](vtkPolyData* output)
  {
    std::vector<double> everything = pointsOf(output);
    for (const char* const name : { "Normals", "Radius", "position", "x", "distance" })
    {
      vtkDataArray* const array = output->GetPointData()->GetArray(name);
      for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
      {
        everything.push_back(array->GetVariantValue(i).ToDouble());
      }
    }
    return everything;
  };
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
            vtkNew<vtkScatteredIsopointFilter> filter;
            filter->SetInputData(cloud);
            filter->SetUseAllCores(useAllCores);
            filter->SetValue(0, 0.7);
            filter->Update();
            const std::vector<double> found = everythingOf(filter->GetOutput());
            expected = expected.empty() ? found : expected;
            EXPECT_EQ(found, expected) << backend << " " << threads;
          });
      }
    }
  }
  EXPECT_FALSE(expected.empty());
}

TEST(Filter, AKeptTreeGivesWhatAFreshOneDoes)
{
  const auto cloud = newCloud(20000);
  vtkNew<vtkScatteredIsopointFilter> kept;
  kept->SetInputData(cloud);
  const auto compare = [&]()
  {
    kept->Update();
    vtkNew<vtkScatteredIsopointFilter> fresh;
    fresh->SetInputData(cloud);
    fresh->KeepTreeOff();
    fresh->SetValue(0, kept->GetValue(0));
    fresh->SetAngle(kept->GetAngle());
    fresh->Update();
    EXPECT_GT(fresh->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(pointsOf(kept->GetOutput()), pointsOf(fresh->GetOutput()));
  };
  kept->SetValue(0, 0.7);
  compare();
  kept->SetValue(0, 0.5);
  compare();
  kept->SetAngle(30.0);
  compare();

  // New values in place, in a new array, and then new positions.
  vtkDataArray* const distance = cloud->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < 20000; i += 3)
  {
    distance->SetComponent(i, 0, 0.9 * distance->GetComponent(i, 0));
  }
  distance->Modified();
  compare();
  const auto replaced = newArray<vtkDoubleArray>("distance", 20000);
  for (vtkIdType i = 0; i < 20000; ++i)
  {
    replaced->SetValue(i, 0.4 + std::abs(cloud->GetPoint(i)[2]));
  }
  cloud->GetPointData()->SetScalars(replaced);
  compare();
  vtkNew<vtkPoints> moved;
  moved->DeepCopy(cloud->GetPoints());
  moved->SetPoint(17, 0.1, 0.2, 0.3);
  cloud->SetPoints(moved);
  compare();
}

// A data set that only says itself that it changed, and coordinates of a grid.
TEST(Filter, AKeptTreeSeesPositionsChangedInPlace)
{
  const auto expectFresh = [](vtkScatteredIsopointFilter* kept, vtkDataSet* input, double isovalue)
  {
    kept->SetValue(0, isovalue);
    kept->Update();
    vtkNew<vtkScatteredIsopointFilter> fresh;
    fresh->SetInputData(input);
    fresh->SetValue(0, isovalue);
    fresh->Update();
    EXPECT_GT(fresh->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(pointsOf(kept->GetOutput()), pointsOf(fresh->GetOutput()));
  };
  const auto cloud = newCloud(3000);
  vtkNew<vtkScatteredIsopointFilter> kept;
  kept->SetInputData(cloud);
  expectFresh(kept, cloud, 0.7);
  for (vtkIdType i = 0; i < 3000; i += 2)
  {
    const double* const p = cloud->GetPoint(i);
    cloud->GetPoints()->SetPoint(i, p[1], 1.5 * p[0], p[2]);
  }
  cloud->Modified();
  expectFresh(kept, cloud, 0.6);

  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(9, 9, 9);
  vtkNew<vtkDoubleArray> coordinates[3];
  const auto values = newArray("values", 9 * 9 * 9);
  for (int i = 0; i < 9; ++i)
  {
    for (vtkDoubleArray* const array :
      { coordinates[0].Get(), coordinates[1].Get(), coordinates[2].Get() })
    {
      array->InsertNextValue(0.1 * i);
    }
  }
  for (vtkIdType i = 0; i < 9 * 9 * 9; ++i)
  {
    values->SetValue(i, static_cast<float>((i * 37) % 101));
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  grid->GetPointData()->SetScalars(values);
  kept->SetInputData(grid);
  expectFresh(kept, grid, 50.5);
  coordinates[0]->SetValue(8, 7.0);
  coordinates[0]->SetValue(7, 5.0);
  coordinates[0]->Modified();
  expectFresh(kept, grid, 30.5);
}

// Two data sets that share an array changed last of all.
TEST(Filter, AKeptTreeTellsDataSetsApartThatShareScalars)
{
  const auto first = newCloud(3000);
  vtkNew<vtkPolyData> second;
  vtkNew<vtkPoints> moved;
  moved->DeepCopy(first->GetPoints());
  for (vtkIdType i = 0; i < 3000; ++i)
  {
    const double* const p = first->GetPoint(i);
    moved->SetPoint(i, p[2], 3.0 * p[0], p[1] * p[1]);
  }
  second->SetPoints(moved);
  second->GetPointData()->SetScalars(first->GetPointData()->GetScalars());
  first->GetPointData()->GetScalars()->Modified();
  const auto pointsFrom = [](vtkScatteredIsopointFilter* filter, vtkPolyData* input)
  {
    filter->SetInputData(input);
    filter->SetValue(0, 0.7);
    filter->Update();
    return pointsOf(filter->GetOutput());
  };
  vtkNew<vtkScatteredIsopointFilter> kept;
  vtkNew<vtkScatteredIsopointFilter> fresh;
  pointsFrom(kept, first);
  EXPECT_EQ(pointsFrom(kept, second), pointsFrom(fresh, second));
}

TEST(Filter, ArraysOfAnotherLengthAreLeftOut)
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

TEST(Filter, AnArrayThatGivesWayIsWarnedOf)
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
  filter->ComputeRadiiOff();
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("Radius")->GetComponent(0, 0), 0.7);
}

TEST(Filter, ProgressRisesAndAbortLeavesAReusableFilter)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(100000));
  filter->SetValue(0, 0.7);
  struct Watcher : vtkCommand
  {
    void Execute(vtkObject* caller, unsigned long, void*) override
    {
      auto* const algorithm = static_cast<vtkAlgorithm*>(caller);
      this->Progress.push_back(algorithm->GetProgress());
      if (this->Progress.back() >= this->AbortAt)
      {
        algorithm->SetAbortExecute(1);
      }
    }
    std::vector<double> Progress;
    double AbortAt = 2.0;
  };
  const auto watcher = vtkSmartPointer<Watcher>::Take(new Watcher);
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->Update();
  EXPECT_GE(watcher->Progress.size(), 5u);
  EXPECT_TRUE(std::is_sorted(watcher->Progress.begin(), watcher->Progress.end()));
  EXPECT_EQ(watcher->Progress.back(), 1.0);
  const std::vector<double> expected = pointsOf(filter->GetOutput());

  for (const double abortAt : { 0.05, 0.3, 0.6, 0.8 })
  {
    watcher->AbortAt = abortAt;
    filter->SetValue(0, 0.3 + abortAt);
    filter->Update();
    expectEmpty(filter->GetOutput());
    watcher->AbortAt = 2.0;
    filter->SetAbortExecute(0);
    filter->SetValue(0, 0.7);
    filter->Update();
    EXPECT_EQ(pointsOf(filter->GetOutput()), expected);
  }
}

TEST(Filter, ThinnedPointsAreSomeOfAll)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(20000));
  filter->SetValue(0, 0.7);
  filter->SetValue(1, 0.5);
  filter->ComputeProjectionOrdersOn();
  for (const int projection :
    { vtkScatteredIsopointFilter::NO_PROJECTION, vtkScatteredIsopointFilter::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    filter->SetMinimumSpacing(0.0);
    filter->Update();
    vtkNew<vtkPolyData> all;
    all->DeepCopy(filter->GetOutput());
    filter->SetMinimumSpacing(0.5);
    filter->Update();
    vtkPolyData* const few = filter->GetOutput();
    EXPECT_GT(few->GetNumberOfPoints(), 0.3 * all->GetNumberOfPoints());
    EXPECT_LT(few->GetNumberOfPoints(), 0.6 * all->GetNumberOfPoints());
    EXPECT_EQ(few->GetNumberOfVerts(), few->GetNumberOfPoints());
    vtkIdType next = 0;
    vtkIdType unprojected = 0;
    for (vtkIdType i = 0; i < few->GetNumberOfPoints(); ++i, ++next)
    {
      while (next < all->GetNumberOfPoints() &&
             !std::equal(few->GetPoint(i), few->GetPoint(i) + 3, all->GetPoint(next)))
      {
        ++next;
      }
      ASSERT_LT(next, all->GetNumberOfPoints());
      for (const char* const name : { "distance", "x", "position", "ProjectionOrder" })
      {
        vtkDataArray* const array = few->GetPointData()->GetArray(name);
        for (int component = 0; component < array->GetNumberOfComponents(); ++component)
        {
          ASSERT_EQ(array->GetComponent(i, component),
            all->GetPointData()->GetArray(name)->GetComponent(next, component))
            << name;
        }
      }
      unprojected +=
        few->GetPointData()->GetArray("ProjectionOrder")->GetComponent(i, 0) == 0.0 ? 1 : 0;
    }
    EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), unprojected);
    filter->SetMinimumSpacing(0.0);
    filter->Update();
    EXPECT_EQ(pointsOf(filter->GetOutput()), pointsOf(all));
  }
}

TEST(Filter, ThinningNeedsNoOtherOutput)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(20000));
  filter->SetValue(0, 0.7);
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->ComputeNormalsOff();
  filter->ComputeRadiiOff();
  filter->Update();
  const vtkIdType all = filter->GetOutput()->GetNumberOfPoints();
  filter->SetMinimumSpacing(0.5);
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), 0.6 * all);
  EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), filter->GetOutput()->GetNumberOfPoints());
}
