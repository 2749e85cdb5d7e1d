// SPDX-License-Identifier: GPL-3.0-or-later
// The output of an update: points, conventions, order, precision, arrays; the options that move or
// drop points; the same for any number of threads.
#include "FilterTesting.h"

#include "vtkIdTypeArray.h"
#include "vtkSMPTools.h"

#include <set>

using namespace filtertesting;

TEST(Filter, OutputFollowsTheConventions)
{
  const auto filter = newFilter(newCloud(20000));
  const auto errors = watchErrors(filter);
  vtkPolyData* const output = outputOf(filter);
  const vtkIdType count = output->GetNumberOfPoints();
  ASSERT_GT(count, 1000);
  EXPECT_EQ(output->GetNumberOfVerts(), count);
  EXPECT_EQ(output->GetNumberOfCells(), count);
  EXPECT_EQ(output->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);

  vtkPointData* const data = output->GetPointData();
  EXPECT_TRUE(data->GetScalars() && data->GetScalars() == data->GetArray("distance"));
  EXPECT_TRUE(data->GetNormals() && data->GetNormals() == data->GetArray("Normals"));
  EXPECT_TRUE(vtkFloatArray::SafeDownCast(data->GetNormals()));
  EXPECT_TRUE(vtkFloatArray::SafeDownCast(data->GetArray("Radius")));
  ASSERT_EQ(data->GetArray("position")->GetNumberOfComponents(), 3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    output->GetVerts()->GetCellAtId(i, size, ids);
    ASSERT_TRUE(size == 1 && ids[0] == i);
    ASSERT_EQ(data->GetScalars()->GetComponent(i, 0), 0.7);
    const Vector p = placeOf(output, i);
    ASSERT_NEAR(length(p), 0.7, 0.03);
    ASSERT_LT(dot(tupleOf(data->GetNormals(), i), p) / length(p), -0.95); // outward
    ASSERT_EQ(
      data->GetArray("x")->GetComponent(i, 0), data->GetArray("position")->GetComponent(i, 0));
    ASSERT_GE(data->GetArray("Radius")->GetComponent(i, 0), 0.0);
  }
  filter->SetValue(0, 99.0);
  expectEmpty(outputOf(filter));
  for (const char* const name : { "distance", "x", "position", "Normals", "Radius" })
  {
    EXPECT_TRUE(data->HasArray(name)) << name;
  }
  for (const char* const name : { "SplatAxis", "SplatPolygon" })
  {
    EXPECT_TRUE(output->GetCellData()->HasArray(name)) << name;
  }
  EXPECT_EQ(errors->count(), 0u);
}

TEST(Filter, SeveralIsovaluesAreOrderedAndRepeatedOnesCountOnce)
{
  const auto cloud = newCloud(5000);
  for (vtkScatteredContourFilter* const filter : bothFilters(cloud))
  {
    SCOPED_TRACE(filter->GetClassName());
    std::vector<double> points;
    std::vector<double> isovalues;
    std::vector<std::array<vtkIdType, 3>> triangles;
    for (const double isovalue : { 0.4, 0.6, 0.8 })
    {
      filter->SetValue(0, isovalue);
      const std::vector<double> more = pointsOf(outputOf(filter));
      const auto first = static_cast<vtkIdType>(isovalues.size());
      for (const auto& [a, b, c] : trianglesOf(filter->GetOutput()))
      {
        triangles.push_back({ first + a, first + b, first + c });
      }
      EXPECT_FALSE(more.empty());
      points.insert(points.end(), more.begin(), more.end());
      isovalues.insert(isovalues.end(), more.size() / 3, isovalue);
    }
    filter->SetValue(0, 0.8);
    filter->SetValue(1, 0.4);
    filter->SetValue(2, 0.6);
    filter->SetValue(3, 0.8);
    EXPECT_EQ(pointsOf(outputOf(filter)), points);
    EXPECT_EQ(trianglesOf(filter->GetOutput()), triangles);
    EXPECT_EQ(numbersOf(filter->GetOutput()->GetPointData()->GetScalars()), isovalues);
    filter->GenerateValues(3, 0.4, 0.8);
    EXPECT_EQ(filter->GetNumberOfContours(), 3);
    EXPECT_EQ(pointsOf(outputOf(filter)).size(), points.size());
  }
}

TEST(Filter, PrecisionOfThePoints)
{
  for (const int inputType : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto filter = newFilter(newCloud(500, inputType));
    const std::vector<std::pair<int, int>> types{ { vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
      { vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE },
      { vtkAlgorithm::DEFAULT_PRECISION, inputType } };
    for (const auto& [precision, type] : types)
    {
      filter->SetOutputPointsPrecision(precision);
      EXPECT_EQ(outputOf(filter)->GetPoints()->GetDataType(), type);
    }
  }
}

TEST(Filter, ArraysAreSwitchedWithoutEffectOnPoints)
{
  const auto cloud = newCloud(20000);
  for (vtkScatteredContourFilter* const filter : bothFilters(cloud))
  {
    SCOPED_TRACE(filter->GetClassName());
    const std::vector<double> points = pointsOf(outputOf(filter));
    const auto triangles = trianglesOf(filter->GetOutput());
    filter->ComputeNormalsOff();
    filter->ComputeScalarsOff();
    filter->ComputeGradientsOn();
    filter->ComputeProjectionOrdersOn();
    if (auto* const isopoints = Isopoints::SafeDownCast(filter))
    {
      isopoints->ComputeSplatsOff();
    }
    vtkPolyData* const output = outputOf(filter);
    std::set<std::string> names;
    for (int i = 0; i < output->GetPointData()->GetNumberOfArrays(); ++i)
    {
      names.insert(output->GetPointData()->GetArrayName(i));
    }
    EXPECT_EQ(names, (std::set<std::string>{ "x", "position", "Gradients", "ProjectionOrder" }));
    EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(pointsOf(output), points);
    EXPECT_EQ(trianglesOf(output), triangles);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      ASSERT_GT(dot(placeOf(output, i), tupleOf(findArray(output, "Gradients"), i)), 0.65);
    }
  }
}

// Integers are rounded values: their normals are those of the field before rounding, not of stairs.
TEST(Filter, IntegersAreRoundedValues)
{
  constexpr vtkIdType count = 20000;
  const auto cloud = newCloud(count);
  const auto rounded = [&](vtkIdType i)
  { return std::round(20.0 * distancesOf(cloud)->GetValue(i)); };
  cloud->GetPointData()->AddArray(arrayOf<vtkIntArray>("integers", count, rounded));
  cloud->GetPointData()->AddArray(arrayOf("numbers", count, rounded));
  const auto filter = newFilter(cloud, 14.3);
  const auto meanSine = [&filter](const char* name)
  {
    filter->SetInputArrayToProcess(0, 0, 0, ofPoints, name);
    vtkPolyData* const isopoints = outputOf(filter);
    double sum = 0.0;
    for (vtkIdType i = 0; i < isopoints->GetNumberOfPoints(); ++i)
    {
      const Vector p = placeOf(isopoints, i);
      sum += length(analytic::cross(p, tupleOf(findArray(isopoints, "Normals"), i))) / length(p);
    }
    return sum / static_cast<double>(isopoints->GetNumberOfPoints());
  };
  const double exact = meanSine("numbers");
  EXPECT_LT(meanSine("integers"), 0.7 * exact);
  EXPECT_EQ(meanSine("numbers"), exact); // nothing is left of the error of the integers
}

TEST(Filter, ScalarsOfAnyType)
{
  for (const int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_FLOAT, VTK_DOUBLE, VTK_ID_TYPE })
  {
    SCOPED_TRACE(type);
    const auto cloud = newCloud(4000);
    const auto typed = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    typed->SetName("typed");
    typed->SetNumberOfTuples(4000);
    for (vtkIdType i = 0; i < 4000; ++i)
    {
      typed->SetComponent(i, 0, std::floor(60.0 * distancesOf(cloud)->GetValue(i)));
    }
    cloud->GetPointData()->SetScalars(typed);
    const auto filter = newFilter(cloud, 42.5);
    ASSERT_GT(outputOf(filter)->GetNumberOfPoints(), 100);
    vtkDataArray* const contoured = findArray(filter->GetOutput(), "typed");
    EXPECT_EQ(contoured->GetDataType(), type == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
    EXPECT_EQ(contoured->GetComponent(0, 0), 42.5);
    EXPECT_NEAR(length(placeOf(filter->GetOutput(), 0)), 0.71, 0.05);
  }
}

TEST(Filter, NumbersAreInterpolatedAndOtherArraysCopied)
{
  const auto pair =
    cloudOf({ { 0.0, 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0, 3.0 }, { 1.0, 0.0, 0.0, 5.0 } });
  vtkPointData* const input = pair->GetPointData();
  input->AddArray(arrayOf<vtkIntArray>("whole", 3, [](vtkIdType i) { return 10 * i; }));
  input->SetPedigreeIds(
    arrayOf<vtkIdTypeArray>("pedigree", 3, [](vtkIdType i) { return 100 + i; }));
  input->SetGlobalIds(arrayOf<vtkIdTypeArray>("global", 3, [](vtkIdType i) { return i; }));
  input->AddArray(textsOf("names", 3, [](vtkIdType i) { return std::string("abc").substr(i, 1); }));
  input->AddArray(newArray("of another length", 5));
  const auto filter = newFilter(pair, 3.0);
  const auto errors = watchErrors(filter);
  ASSERT_EQ(outputOf(filter)->GetNumberOfPoints(), 1);
  EXPECT_EQ(errors->count(), 0u);
  vtkPointData* const output = filter->GetOutput()->GetPointData();
  EXPECT_EQ(filter->GetOutput()->GetPoint(0)[0], 0.75);         // the coincident two count as 4
  EXPECT_EQ(output->GetArray("whole")->GetComponent(0, 0), 11); // 0.75 * (10 + 20) / 2, rounded
  ASSERT_TRUE(output->GetPedigreeIds());
  EXPECT_EQ(output->GetPedigreeIds()->GetVariantValue(0).ToInt(), 101);
  EXPECT_FALSE(output->GetGlobalIds());
  auto* const outputNames = vtkStringArray::SafeDownCast(output->GetAbstractArray("names"));
  ASSERT_TRUE(outputNames);
  EXPECT_EQ(outputNames->GetValue(0), "b");
  EXPECT_FALSE(output->HasArray("of another length"));
}

TEST(Filter, AComputedArrayThatReplacesAnInputArrayIsWarnedOf)
{
  const auto cloud = newCloud(500);
  distancesOf(cloud)->SetName("Radius");
  const auto filter = newFilter(cloud);
  const auto warnings = watchMessages(filter, vtkCommand::WarningEvent);
  filter->Update();
  EXPECT_EQ(warnings->count(), 1u);
  filter->ComputeSplatsOff();
  EXPECT_EQ(findArray(outputOf(filter), "Radius")->GetComponent(0, 0), 0.7);
  // Shapes of splats are arrays of the vertices, and replace none of points.
  filter->ComputeSplatsOn();
  cloud->GetPointData()->GetScalars()->SetName("SplatAxis");
  cloud->Modified();
  EXPECT_EQ(findArray(outputOf(filter), "SplatAxis")->GetComponent(0, 0), 0.7);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetArray("SplatAxis")->GetNumberOfComponents(), 3);
  EXPECT_EQ(warnings->count(), 1u);
}

// A projected point has the attributes of the nearest place on its edge.
TEST(Filter, ProjectionMovesPointsAndTheirAttributes)
{
  const auto filter = newFilter(newCloud(20000));
  filter->ComputeProjectionOrdersOn();
  filter->ComputeGradientsOn();
  std::vector<std::vector<double>> positions; // for each projection
  std::vector<double> deviations;
  for (const int projection : { Isopoints::NO_PROJECTION, Isopoints::LINEAR_FIT,
         Isopoints::QUADRATIC_FIT, Isopoints::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    vtkPolyData* const output = outputOf(filter);
    positions.push_back(pointsOf(output));
    vtkDataArray* const orders = findArray(output, "ProjectionOrder");
    double deviation = 0.0;
    vtkIdType unprojected = 0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const Vector p = placeOf(output, i);
      const Vector onEdge = tupleOf(findArray(output, "position"), i);
      const double* const q = positions[0].data() + 3 * i;
      const Vector unmoved{ q[0], q[1], q[2] };
      ASSERT_LE(length(p - onEdge), length(p - unmoved) + 1e-6);
      deviation = std::max(deviation, std::abs(length(p) - 0.7));
      const double order = orders->GetComponent(i, 0);
      ASSERT_LE(order, projection);
      unprojected += order == 0.0 ? 1 : 0;
      if (order > 0.0)
      {
        ASSERT_NEAR(length(tupleOf(findArray(output, "Gradients"), i)), 1.0, 0.1);
      }
      ASSERT_EQ(output->GetPointData()->GetScalars()->GetComponent(i, 0), 0.7);
    }
    EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), unprojected);
    deviations.push_back(deviation);
  }
  ASSERT_EQ(positions[0].size(), positions[2].size());
  EXPECT_NE(positions[0], positions[1]);
  EXPECT_LT(deviations[2], 0.1 * deviations[0]);
}

// Two halves of a cloud, far apart. The surface of "f" crosses one of them and the void.
TEST(Filter, DropGapsDropsWhatIsInVoids)
{
  const auto cloud = newCloud(20000);
  cloud->GetPointData()->AddArray(arrayOf("f", cloud->GetNumberOfPoints(),
    [&](vtkIdType i)
    { return cloud->GetPoint(i)[1] + (cloud->GetPoint(i)[0] > 0.0 ? 0.0 : 5.0); }));
  move(cloud->GetPoints(),
    [](const Vector& p) {
      return Vector{ p[0] + (p[0] > 0.0 ? 5.0 : -5.0), p[1], p[2] };
    });
  for (vtkScatteredContourFilter* const filter : bothFilters(cloud, 0.1))
  {
    SCOPED_TRACE(filter->GetClassName());
    const auto count = [&](const char* array, double isovalue, bool dropsGaps)
    {
      filter->SetInputArrayToProcess(0, 0, 0, ofPoints, array);
      filter->SetValue(0, isovalue);
      filter->SetDropGaps(dropsGaps);
      const vtkIdType cells = outputOf(filter)->GetNumberOfCells();
      EXPECT_EQ(filter->GetNumberOfDroppedInGaps() > 0, dropsGaps);
      return static_cast<double>(cells);
    };
    EXPECT_GT(count("x", 0.0, false), 0.0); // all of them in the void
    EXPECT_EQ(count("x", 0.0, true), 0.0);
    EXPECT_GT(count("distance", 0.7, true), 0.95 * count("distance", 0.7, false));
    EXPECT_GT(count("f", 0.1, true), 0.25 * count("f", 0.1, false));
    EXPECT_LT(count("f", 0.1, true), count("f", 0.1, false));
  }
}

TEST(Filter, SameBytesForAnyBackendAndNumberOfThreads)
{
  const auto cloud = newCloud(150000);
  const std::string former = vtkSMPTools::GetBackend();
  for (vtkScatteredContourFilter* const filter : bothFilters(cloud))
  {
    SCOPED_TRACE(filter->GetClassName());
    filter->KeepTreeOff();
    filter->ComputeGradientsOn();
    filter->ComputeProjectionOrdersOn();
    std::vector<double> expected;
    for (const char* const backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
    {
      if (!vtkSMPTools::SetBackend(backend))
      {
        continue; // not built into this VTK
      }
      vtkSMPTools::SetBackend(former.c_str());
      for (const int run : { 0, 1, 2, 3, 4, 5 })
      {
        const int threads = 1 << run / 2;
        filter->SetUseAllCores(run % 2);
        filter->Modified();
        vtkSMPTools::LocalScope(
          vtkSMPTools::Config{ threads, backend, false }, [&]() { filter->Update(); });
        const std::vector<double> found = everythingOf(filter->GetOutput());
        expected = expected.empty() ? found : expected;
        EXPECT_TRUE(found == expected) << backend << " " << threads;
      }
    }
    EXPECT_FALSE(expected.empty());
  }
}
