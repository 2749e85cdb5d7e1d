// SPDX-License-Identifier: GPL-3.0-or-later
// The filter's splat arrays: axes and clip planes.
#include "FilterTesting.h"

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

/// Whether the clip plane of a splat is the plane of one of the cube's faces, a thousandth of the
/// spacing of about 1 farther off, to the side of the cube.
bool isClippedAtAFace(const double* point, const std::array<double, 3>& center, const double* clip)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double tolerance = 1e-4;
    const double side = clip[axis] < 0.0 ? 1.0 : -1.0;
    const double inside = 12.0 - side * (point[axis] - center[axis]);
    if (std::abs(clip[axis]) > 1.0 - tolerance && clip[3] > inside - tolerance &&
        clip[3] < inside + 0.02)
    {
      return true;
    }
  }
  return false;
}

} // namespace

TEST(FilterSplats, ArraysArePresentIfRequested)
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
    ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 100);
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
      ASSERT_LT(outwards, 0.0); // distances decrease inwards
    }
  }
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

TEST(FilterSplats, ClipsComeWithTheFitForCreases)
{
  using Filter = vtkScatteredIsopointFilter;
  vtkNew<Filter> filter;
  filter->SetInputData(newCubeCloud({ 0.0, 0.0, 0.0 }));
  filter->SetValue(0, 0.0);
  const auto hasClips = [&filter]()
  {
    filter->Update();
    return filter->GetOutput()->GetPointData()->HasArray("SplatClip") != 0;
  };
  EXPECT_FALSE(hasClips());
  filter->SetProjection(Filter::CREASE_FIT);
  EXPECT_TRUE(hasClips());
  filter->ComputeSplatClipsOff();
  EXPECT_FALSE(hasClips());
  filter->SetProjection(Filter::CUBIC_FIT);
  filter->ComputeSplatClipsOn();
  EXPECT_TRUE(hasClips());
}

// Far from the origin, coordinates in single precision have errors of several sample spacings.
TEST(FilterSplats, ClipPlanesAreRelativeToThePoints)
{
  for (const std::array<double, 3> center :
    { std::array<double, 3>{ 0.0, 0.0, 0.0 }, std::array<double, 3>{ 1e8, 2e8, -1e8 } })
  {
    vtkNew<vtkScatteredIsopointFilter> filter;
    filter->SetInputData(newCubeCloud(center));
    filter->SetValue(0, 0.0);
    filter->SetProjection(vtkScatteredIsopointFilter::CREASE_FIT);
    filter->ComputeSplatClipsOn();
    filter->Update();
    vtkDataArray* const clips = filter->GetOutput()->GetPointData()->GetArray("SplatClip");
    int clipped = 0;
    int wrong = 0;
    for (vtkIdType i = 0; i < clips->GetNumberOfTuples(); ++i)
    {
      double clip[5];
      clips->GetTuple(i, clip);
      ASSERT_GE(clip[3], 0.0);
      if (clip[0] != 0.0 || clip[1] != 0.0 || clip[2] != 0.0)
      {
        ASSERT_NEAR(std::hypot(clip[0], clip[1], clip[2]), 1.0, 1e-6);
        ASSERT_EQ(clip[4], -1.0); // a convex edge
        wrong += isClippedAtAFace(filter->GetOutput()->GetPoint(i), center, clip) ? 0 : 1;
        clipped += clip[3] > 0.0 ? 1 : 0;
      }
      else
      {
        ASSERT_EQ(clip[3], 0.0);
        ASSERT_EQ(clip[4], 0.0);
      }
    }
    EXPECT_GT(clipped, 500);
    EXPECT_LT(wrong, clipped / 20); // fits at corners may be off
  }
}
