// SPDX-License-Identifier: GPL-3.0-or-later
// The filter's arrays of splats: axes and polygons.
#include "SplatCoverage.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

using namespace filtertesting;

namespace
{

/// A corner of a splat in its frame: along the axis, across it, and along the normal, in radii.
Vector cornerOf(vtkPolyData* output, vtkIdType point, int corner)
{
  vtkDataArray* const polygons = output->GetCellData()->GetArray("SplatPolygon");
  const auto number = [&](int i) { return polygons->GetComponent(point, 5 * corner + i); };
  return { number(0), number(1), number(2) };
}

} // namespace

TEST(FilterSplats, ArraysArePresentIfRequested)
{
  const auto filter = newFilter(newCloud(5000));
  for (const int method : { Isopoints::NORMALS_FROM_FIELD, Isopoints::NORMALS_FROM_PLANES })
  {
    filter->SetNormalMethod(method);
    vtkPolyData* const output = outputOf(filter);
    const vtkIdType count = output->GetNumberOfPoints();
    ASSERT_GT(count, 100);
    EXPECT_FALSE(output->GetPointData()->HasArray("Gradients"));
    vtkCellData* const cells = output->GetCellData();
    EXPECT_EQ(cells->GetArray("SplatPolygon")->GetNumberOfComponents(), 40);
    EXPECT_EQ(cells->GetVectors(), cells->GetArray("SplatAxis"));
    for (const char* const name : { "SplatAxis", "SplatPolygon" })
    {
      EXPECT_FALSE(output->GetPointData()->HasArray(name)) << name;
      EXPECT_EQ(cells->GetArray(name)->GetNumberOfTuples(), count);
      EXPECT_EQ(cells->GetArray(name)->GetInformation()->Get(vtkAbstractArray::GUI_HIDE()), 1);
    }
    vtkIdType hidden = 0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      const Vector axis = tupleOf(cells->GetArray("SplatAxis"), i);
      const double radius = findArray(output, "Radius")->GetComponent(i, 0);
      ASSERT_NEAR(length(axis), radius, 1e-6);
      ASSERT_NEAR(dot(axis, tupleOf(output->GetPointData()->GetNormals(), i)), 0.0, 1e-6);
      double farthest = 0.0;
      double doubleArea = 0.0; // of the fan, in its plane
      for (int k = 0; k < 8; ++k)
      {
        const Vector a = cornerOf(output, i, k);
        const Vector b = cornerOf(output, i, (k + 1) % 8);
        farthest = std::max(farthest, length(a));
        doubleArea += a[0] * b[1] - a[1] * b[0];
      }
      const bool isHidden = radius == 0.0;
      hidden += isHidden ? 1 : 0;
      ASSERT_NEAR(farthest, isHidden ? 0.0 : 1.0, isHidden ? 0.0 : 1e-6);
      ASSERT_TRUE(isHidden || doubleArea > 0.1);
    }
    EXPECT_LT(hidden, count / 10);
  }
}

TEST(FilterSplats, NormalsAreThoseOfFitsOnlyWhereFitsAreMade)
{
  const auto filter = newFilter(newCloud(5000));
  const auto normals = [&filter](int method)
  {
    filter->SetNormalMethod(method);
    return numbersOf(outputOf(filter)->GetPointData()->GetNormals());
  };
  const auto expectAutomatic = [&normals](int method, int other)
  {
    const std::vector<double> automatic = normals(Isopoints::AUTOMATIC_NORMALS);
    EXPECT_EQ(automatic, normals(method));
    EXPECT_NE(automatic, normals(other));
  };
  EXPECT_EQ(filter->GetNormalMethod(), Isopoints::AUTOMATIC_NORMALS);
  expectAutomatic(Isopoints::NORMALS_FROM_FIELD, Isopoints::NORMALS_FROM_PLANES);
  filter->SetProjection(Isopoints::NO_PROJECTION);
  expectAutomatic(Isopoints::NORMALS_FROM_PLANES, Isopoints::NORMALS_FROM_FIELD);
  filter->ComputeGradientsOn();
  expectAutomatic(Isopoints::NORMALS_FROM_FIELD, Isopoints::NORMALS_FROM_PLANES);
}

// Far from the origin, coordinates in single precision have errors of several sample spacings;
// those of splats are relative to their points. All corners lie on the cube, or nearly so at its
// edges.
TEST(FilterSplats, EndAtCreasesWhereverTheyAre)
{
  for (const Vector center : { Vector{ 0.0, 0.0, 0.0 }, Vector{ 1e8, 2e8, -1e8 } })
  {
    // Samples with a spacing of 1 whose scalars are 0 on the faces of a cube.
    const auto cloud = newCloud(64000, VTK_DOUBLE);
    const auto toCenter = [](const Vector& p) {
      return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) });
    };
    move(cloud->GetPoints(), [&](const Vector& p) { return 20.0 * p + center; });
    setScalars(cloud, [&](const Vector& p) { return 12.0 - toCenter(p - center); });
    const auto filter = newFilter(cloud, 0.0);
    filter->SetProjection(Isopoints::CREASE_FIT);
    int corners = 0;
    int astray = 0;
    for (const splatcoverage::Splat& splat : splatcoverage::splatsOf(outputOf(filter)))
    {
      for (const Vector& corner : splat.corners)
      {
        astray += std::abs(toCenter(corner - center) - 12.0) > 0.05 ? 1 : 0;
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
  const Samples samples = latticeOf(21,
    [](const Vector& p)
    {
      return 200.0 * std::exp(-dot(p, p) / 100.0) + 10.0 * std::sin(3.0 * p[0]) +
             18.0 * std::sin(1.5 * p[1]) + 5.0 * std::cos(2.0 * p[2]);
    });
  const auto filter = newFilter(cloudOf(samples));
  for (const double isovalue : { 100.0, 140.0 })
  {
    filter->SetValue(0, isovalue);
    vtkDataArray* const radii = findArray(outputOf(filter), "Radius");
    ASSERT_GT(radii->GetNumberOfTuples(), 500);
    EXPECT_LT(radii->GetRange()[1], 2.2); // 1.3 spacings at borders, and overlaps
  }
}
