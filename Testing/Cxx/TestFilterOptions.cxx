// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the filter that move or drop points: projection, gaps, minimum spacing.
#include "FilterTesting.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace filtertesting;

// A projected point has the attributes of the nearest place on its edge.
TEST(FilterOptions, ProjectionMovesPointsAndTheirAttributes)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(20000));
  filter->SetValue(0, 0.7);
  filter->ComputeProjectionOrdersOn();
  filter->ComputeGradientsOn();
  std::vector<std::vector<double>> positions; // for each projection
  std::vector<double> deviations;
  for (const int projection :
    { vtkScatteredIsopointFilter::NO_PROJECTION, vtkScatteredIsopointFilter::LINEAR_FIT,
      vtkScatteredIsopointFilter::QUADRATIC_FIT, vtkScatteredIsopointFilter::CUBIC_FIT })
  {
    filter->SetProjection(projection);
    filter->Update();
    vtkPolyData* const output = filter->GetOutput();
    positions.push_back(pointsOf(output));
    vtkDataArray* const orders = output->GetPointData()->GetArray("ProjectionOrder");
    vtkDataArray* const attribute = output->GetPointData()->GetArray("position");
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
      attribute->GetTuple(i, onEdge);
      gradients->GetTuple(i, gradient);
      const double* const unmoved = positions[0].data() + 3 * i;
      const auto distance = [](const double* a, const double* b)
      { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); };
      ASSERT_LE(distance(p, onEdge), distance(p, unmoved) + 1e-6);
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
  ASSERT_EQ(positions[0].size(), positions[2].size());
  EXPECT_NE(positions[0], positions[1]);
  EXPECT_LT(deviations[2], 0.1 * deviations[0]);
}

TEST(FilterOptions, DropGapsDropsPointsInVoids)
{
  const auto cloud = newCloud(20000);
  // Divided at x = 0, with a gap five times as wide as the cloud was.
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    p[0] += p[0] > 0.0 ? 10.0 : 0.0;
    cloud->GetPoints()->SetPoint(i, p);
  }
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  const auto count = [&filter](const char* array, double isovalue, bool dropsGaps)
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
    filter->SetValue(0, isovalue);
    filter->SetDropGaps(dropsGaps);
    filter->Update();
    return static_cast<double>(filter->GetOutput()->GetNumberOfPoints());
  };
  EXPECT_GT(count("x", 0.0, false), 0.0); // all of them in the gap
  EXPECT_EQ(count("x", 0.0, true), 0.0);
  EXPECT_GT(count("distance", 0.7, true), 0.95 * count("distance", 0.7, false));
}

TEST(FilterOptions, ThinnedPointsAreASubsetOfAll)
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

TEST(FilterOptions, ThinningNeedsNoOtherOutput)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(20000));
  filter->SetValue(0, 0.7);
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->ComputeNormalsOff();
  filter->ComputeSplatsOff();
  filter->Update();
  const vtkIdType all = filter->GetOutput()->GetNumberOfPoints();
  filter->SetMinimumSpacing(0.5);
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), 0.6 * all);
  EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), filter->GetOutput()->GetNumberOfPoints());
}
