// SPDX-License-Identifier: GPL-3.0-or-later
// The filter's splat arrays: axes and clip planes.
#include "FilterTesting.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace filtertesting;

namespace
{

/// Samples with a spacing of 1 whose scalars are 0 on the faces of a cube.
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

/// The number of an isopoint's array at a corner of its splat.
double cornerNumber(vtkPolyData* data, vtkIdType point, int corner, int number)
{
  return data->GetCellData()->GetArray("SplatPolygon")->GetComponent(point, 5 * corner + number);
}

} // namespace

TEST(FilterSplats, ArraysArePresentIfRequested)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(5000));
  filter->SetValue(0, 0.7);
  const char* const shapes[] = { "SplatAxis", "SplatPolygon" };
  for (const int method : { vtkScatteredIsopointFilter::NORMALS_FROM_FIELD,
         vtkScatteredIsopointFilter::NORMALS_FROM_PLANES })
  {
    filter->SetNormalMethod(method);
    filter->Update();
    vtkPointData* const data = filter->GetOutput()->GetPointData();
    ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 100);
    EXPECT_FALSE(data->HasArray("Gradients"));
    vtkCellData* const cells = filter->GetOutput()->GetCellData();
    EXPECT_EQ(cells->GetArray("SplatPolygon")->GetNumberOfComponents(), 40);
    EXPECT_EQ(cells->GetVectors(), cells->GetArray("SplatAxis"));
    for (const char* const name : shapes)
    {
      EXPECT_FALSE(data->HasArray(name)) << name;
      vtkDataArray* const array = cells->GetArray(name);
      EXPECT_EQ(array->GetNumberOfTuples(), filter->GetOutput()->GetNumberOfPoints());
      EXPECT_EQ(array->GetInformation()->Get(vtkAbstractArray::GUI_HIDE()), 1) << name;
    }
    vtkIdType hidden = 0;
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
    {
      double axis[3];
      double normal[3];
      cells->GetArray("SplatAxis")->GetTuple(i, axis);
      data->GetNormals()->GetTuple(i, normal);
      const double radius = data->GetArray("Radius")->GetComponent(i, 0);
      ASSERT_NEAR(std::hypot(axis[0], axis[1], axis[2]), radius, 1e-6);
      ASSERT_NEAR(axis[0] * normal[0] + axis[1] * normal[1] + axis[2] * normal[2], 0.0, 1e-6);
      double farthest = 0.0;
      double doubleArea = 0.0; // of the fan, in its plane
      for (int k = 0; k < 8; ++k)
      {
        const auto number = [&](int corner, int j)
        { return cornerNumber(filter->GetOutput(), i, corner % 8, j); };
        farthest = std::max(farthest, std::hypot(number(k, 0), number(k, 1), number(k, 2)));
        doubleArea += number(k, 0) * number(k + 1, 1) - number(k, 1) * number(k + 1, 0);
      }
      if (radius == 0.0)
      {
        ++hidden;
        ASSERT_EQ(farthest, 0.0);
        continue;
      }
      ASSERT_NEAR(farthest, 1.0, 1e-6);
      ASSERT_GT(doubleArea, 0.1);
    }
    EXPECT_LT(hidden, filter->GetOutput()->GetNumberOfPoints() / 10);
  }
  filter->ComputeSplatsOff();
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Radius"));
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetNumberOfArrays(), 0);
}

// The arrays of shapes are those of their points in each piece, too.
TEST(FilterSplats, ArePartOfPieces)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(newCloud(5000));
  filter->SetValue(0, 0.7);
  filter->Update();
  vtkNew<vtkPolyData> whole;
  whole->ShallowCopy(filter->GetOutput());
  constexpr int pieces = 3;
  vtkIdType done = 0;
  for (int piece = 0; piece < pieces; ++piece)
  {
    filter->UpdatePiece(piece, pieces, 0);
    vtkPolyData* const part = filter->GetOutput();
    const vtkIdType count = part->GetNumberOfPoints();
    ASSERT_GT(count, 10);
    for (const char* const name : { "SplatAxis", "SplatPolygon" })
    {
      vtkDataArray* const array = part->GetCellData()->GetArray(name);
      vtkDataArray* const all = whole->GetCellData()->GetArray(name);
      ASSERT_EQ(array->GetNumberOfTuples(), count);
      EXPECT_EQ(array->GetInformation()->Get(vtkAbstractArray::GUI_HIDE()), 1) << name;
      for (vtkIdType i = 0; i < count * array->GetNumberOfComponents(); ++i)
      {
        ASSERT_EQ(array->GetVariantValue(i).ToFloat(),
          all->GetVariantValue(done * array->GetNumberOfComponents() + i).ToFloat());
      }
    }
    done += count;
  }
  EXPECT_EQ(done, whole->GetNumberOfPoints());
}

TEST(FilterSplats, NormalsAreThoseOfFitsOnlyWhereFitsAreMade)
{
  using Filter = vtkScatteredIsopointFilter;
  vtkNew<Filter> filter;
  filter->SetInputData(newCloud(5000));
  filter->SetValue(0, 0.7);
  const auto normals = [&filter](int method)
  {
    filter->SetNormalMethod(method);
    filter->Update();
    vtkDataArray* const array = filter->GetOutput()->GetPointData()->GetNormals();
    std::vector<double> all;
    for (vtkIdType i = 0; i < 3 * array->GetNumberOfTuples(); ++i)
    {
      all.push_back(array->GetComponent(i / 3, static_cast<int>(i % 3)));
    }
    return all;
  };
  const auto expectAutomatic = [&normals](int method, int other)
  {
    const std::vector<double> automatic = normals(Filter::AUTOMATIC_NORMALS);
    EXPECT_EQ(automatic, normals(method));
    EXPECT_NE(automatic, normals(other));
  };
  EXPECT_EQ(filter->GetNormalMethod(), Filter::AUTOMATIC_NORMALS);
  expectAutomatic(Filter::NORMALS_FROM_FIELD, Filter::NORMALS_FROM_PLANES);
  filter->SetProjection(Filter::NO_PROJECTION);
  expectAutomatic(Filter::NORMALS_FROM_PLANES, Filter::NORMALS_FROM_FIELD);
  filter->ComputeGradientsOn();
  expectAutomatic(Filter::NORMALS_FROM_FIELD, Filter::NORMALS_FROM_PLANES);
  filter->ComputeGradientsOff();
  filter->SetMinimumSpacing(0.5);
  expectAutomatic(Filter::NORMALS_FROM_FIELD, Filter::NORMALS_FROM_PLANES);
}

// Far from the origin, coordinates in single precision have errors of several sample spacings;
// those of splats are relative to their points. All corners lie on the cube, or nearly so at its
// edges.
TEST(FilterSplats, EndAtCreasesWhereverTheyAre)
{
  for (const std::array<double, 3> center :
    { std::array<double, 3>{ 0.0, 0.0, 0.0 }, std::array<double, 3>{ 1e8, 2e8, -1e8 } })
  {
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(newCubeCloud(center));
    filter->SetValue(0, 0.0);
    filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
    filter->Update();
    vtkPointData* const data = filter->GetOutput()->GetPointData();
    int corners = 0;
    int astray = 0;
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
    {
      double axis[3];
      double normal[3];
      double point[3];
      filter->GetOutput()->GetCellData()->GetArray("SplatAxis")->GetTuple(i, axis);
      data->GetNormals()->GetTuple(i, normal);
      filter->GetOutput()->GetPoint(i, point);
      const double across[3]{ normal[1] * axis[2] - normal[2] * axis[1],
        normal[2] * axis[0] - normal[0] * axis[2], normal[0] * axis[1] - normal[1] * axis[0] };
      const double radius = data->GetArray("Radius")->GetComponent(i, 0);
      for (int k = 0; k < 8; ++k)
      {
        double largest = 0.0;
        for (int j = 0; j < 3; ++j)
        {
          const double offset = cornerNumber(filter->GetOutput(), i, k, 0) * axis[j] +
                                cornerNumber(filter->GetOutput(), i, k, 1) * across[j] +
                                cornerNumber(filter->GetOutput(), i, k, 2) * radius * normal[j];
          largest = std::max(largest, std::abs(point[j] - center[j] + offset));
        }
        astray += std::abs(largest - 12.0) > 0.05 ? 1 : 0;
        ++corners;
      }
    }
    EXPECT_GT(corners, 10000);
    EXPECT_LT(astray, corners / 50); // fits at corners may be off
  }
}

// A field that oscillates as fast as its lattice can hold: normals point anywhere, and where
// nothing bounds a cell, samples show that the surface is not there.
TEST(FilterSplats, EndWhereSamplesShowThatTheSurfaceHasTurnedAway)
{
  constexpr int half = 10;
  constexpr int size = 2 * half + 1;
  vtkNew<vtkPoints> points;
  const auto values = newArray<vtkDoubleArray>("f", size * size * size);
  for (int i = 0; i < size * size * size; ++i)
  {
    const double x = i % size - half;
    const double y = i / size % size - half;
    const double z = i / size / size - half;
    points->InsertNextPoint(x, y, z);
    values->SetValue(i, 200.0 * std::exp(-(x * x + y * y + z * z) / 100.0) +
                          10.0 * std::sin(3.0 * x) + 18.0 * std::sin(1.5 * y) +
                          5.0 * std::cos(2.0 * z));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(values);
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(cloud);
  for (const double isovalue : { 100.0, 140.0 })
  {
    filter->SetValue(0, isovalue);
    filter->Update();
    vtkDataArray* const radii = filter->GetOutput()->GetPointData()->GetArray("Radius");
    ASSERT_GT(radii->GetNumberOfTuples(), 500);
    EXPECT_LT(radii->GetRange()[1], 2.2); // 1.3 spacings at borders, and overlaps
  }
}
