// SPDX-License-Identifier: GPL-3.0-or-later
// A kept tree: updates that reuse it, and changes of the input after which it must not be reused.
#include "FilterTesting.h"

#include "vtkRectilinearGrid.h"

#include <cmath>
#include <vector>

using namespace filtertesting;

TEST(KeptTree, YieldsTheOutputOfANewOne)
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

  // New values in place, then in a new array, then new positions.
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

// Only the data set itself is marked as modified or, of a grid, only an array of coordinates.
TEST(KeptTree, IsNotUsedAfterPositionsChangedInPlace)
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

// Two data sets share scalars that were modified after both of them.
TEST(KeptTree, IsNotUsedForAnotherDataSetWithTheSameScalars)
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
  const std::vector<double> ofFirst = pointsFrom(kept, first);
  const std::vector<double> ofSecond = pointsFrom(fresh, second);
  EXPECT_FALSE(ofSecond.empty());
  EXPECT_NE(ofFirst, ofSecond);
  EXPECT_EQ(pointsFrom(kept, second), ofSecond);
}
