// SPDX-License-Identifier: GPL-3.0-or-later
// The output of an update: points, conventions, order, precision, arrays; the options that move or
// drop points; the same for any number of threads.
#include "FilterTesting.h"

#include "vtkIdTypeArray.h"
#include "vtkSMPTools.h"

using namespace filtertesting;

TEST(Filter, OutputFollowsTheConventions)
{
  const auto filter = newFilter(newCloud(20000));
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
}

TEST(Filter, SeveralIsovaluesAreOrderedAndRepeatedOnesCountOnce)
{
  const auto cloud = newCloud(5000);
  const std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filters{ newFilter(cloud),
    newFilter<Isosurface>(cloud) };
  for (vtkScatteredContourFilter* const filter : filters)
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

TEST(Filter, AnIsovalueOutOfRangeYieldsAnEmptyOutputWithAllArrays)
{
  const auto filter = newFilter(newCloud(500), 99.0);
  const auto errors = watchErrors(filter);
  expectEmpty(outputOf(filter));
  for (const char* const name : { "distance", "x", "position", "Normals", "Radius" })
  {
    EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray(name)) << name;
  }
  EXPECT_EQ(errors->count(), 0u);
}

TEST(Filter, ArraysCanBeSwitchedOff)
{
  const auto filter = newFilter(newCloud(3000));
  filter->ComputeNormalsOff();
  filter->ComputeSplatsOff();
  filter->ComputeScalarsOff();
  EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 0);
  vtkPointData* const data = filter->GetOutput()->GetPointData();
  EXPECT_FALSE(data->GetNormals() || data->HasArray("Radius") || data->HasArray("distance"));
  EXPECT_TRUE(data->HasArray("x"));
}

// Rounding is an error of values, not detail: normals on stairs of integers are those of what was
// rounded.
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
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  std::for_each_n("abc", 3, [&](char name) { names->InsertNextValue(std::string(1, name)); });
  input->AddArray(names);
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

TEST(Filter, GhostsAndSamplesThatAreNotFiniteAreLeftOut)
{
  const auto cloud = newCloud(2000);
  cloud->GetPointData()->AddArray(ghostsOf(2000,
    [](vtkIdType i)
    {
      return i == 3 ? vtkDataSetAttributes::DUPLICATEPOINT
                    : (i == 4 ? vtkDataSetAttributes::HIDDENPOINT : 0);
    }));
  cloud->GetPoints()->SetPoint(5, notANumber, 0.0, 0.0);
  distancesOf(cloud)->SetValue(6, infinity);
  const auto filter = newFilter(cloud);
  EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 4);
  EXPECT_FALSE(findArray(filter->GetOutput(), vtkDataSetAttributes::GhostArrayName()));
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
      ASSERT_LE(
        length(analytic::difference(p, onEdge)), length(analytic::difference(p, unmoved)) + 1e-6);
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

TEST(Filter, DropGapsDropsPointsInVoids)
{
  const auto cloud = newCloud(20000);
  // Divided at x = 0, with a gap five times as wide as the cloud was.
  move(cloud->GetPoints(),
    [](const Vector& p) {
      return Vector{ p[0] + (p[0] > 0.0 ? 10.0 : 0.0), p[1], p[2] };
    });
  const auto filter = newFilter(cloud);
  const auto count = [&filter](const char* array, double isovalue, bool dropsGaps)
  {
    filter->SetInputArrayToProcess(0, 0, 0, ofPoints, array);
    filter->SetValue(0, isovalue);
    filter->SetDropGaps(dropsGaps);
    return static_cast<double>(outputOf(filter)->GetNumberOfPoints());
  };
  EXPECT_GT(count("x", 0.0, false), 0.0); // all of them in the gap
  EXPECT_EQ(count("x", 0.0, true), 0.0);
  EXPECT_GT(count("distance", 0.7, true), 0.95 * count("distance", 0.7, false));
}

TEST(Filter, ThinnedPointsAreASubsetOfAll)
{
  const auto filter = newFilter(newCloud(20000));
  filter->SetValue(1, 0.5);
  filter->ComputeProjectionOrdersOn();
  for (const int projection : { Isopoints::NO_PROJECTION, Isopoints::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    filter->SetMinimumSpacing(0.0);
    vtkNew<vtkPolyData> all;
    all->DeepCopy(outputOf(filter));
    filter->SetMinimumSpacing(0.5);
    vtkPolyData* const few = outputOf(filter);
    EXPECT_GT(few->GetNumberOfPoints(), 0.3 * all->GetNumberOfPoints());
    EXPECT_LT(few->GetNumberOfPoints(), 0.6 * all->GetNumberOfPoints());
    EXPECT_EQ(few->GetNumberOfVerts(), few->GetNumberOfPoints());
    vtkIdType next = 0;
    for (vtkIdType i = 0; i < few->GetNumberOfPoints(); ++i, ++next)
    {
      while (next < all->GetNumberOfPoints() && placeOf(few, i) != placeOf(all, next))
      {
        ++next;
      }
      ASSERT_LT(next, all->GetNumberOfPoints());
      for (const char* const name : { "distance", "x", "position", "ProjectionOrder" })
      {
        vtkDataArray* const array = findArray(few, name);
        for (int component = 0; component < array->GetNumberOfComponents(); ++component)
        {
          ASSERT_EQ(
            array->GetComponent(i, component), findArray(all, name)->GetComponent(next, component))
            << name;
        }
      }
    }
    const std::vector<double> orders = numbersOf(findArray(few, "ProjectionOrder"));
    EXPECT_EQ(
      filter->GetNumberOfUnprojectedPoints(), std::count(orders.begin(), orders.end(), 0.0));
    filter->SetMinimumSpacing(0.0);
    EXPECT_EQ(everythingOf(outputOf(filter)), everythingOf(all));
  }
  const vtkIdType all = filter->GetOutput()->GetNumberOfPoints();
  filter->ComputeNormalsOff();
  filter->ComputeSplatsOff();
  filter->SetProjection(Isopoints::NO_PROJECTION);
  filter->SetMinimumSpacing(0.5);
  EXPECT_LT(outputOf(filter)->GetNumberOfPoints(), 0.6 * all);
  EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), filter->GetOutput()->GetNumberOfPoints());
}

TEST(Filter, SameBytesForAnyBackendAndNumberOfThreads)
{
  const auto cloud = newCloud(150000);
  const std::string former = vtkSMPTools::GetBackend();
  const std::vector<vtkSmartPointer<vtkScatteredContourFilter>> filters{ newFilter(cloud),
    newFilter<Isosurface>(cloud) };
  for (vtkScatteredContourFilter* const filter : filters)
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
