// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of triangles: what it shares with the filter of points, and what it does not.
#include "FilterTesting.h"

#include "vtkContourFilter.h"
#include "vtkDelaunay3D.h"
#include "vtkFeatureEdges.h"
#include "vtkMassProperties.h"
#include "vtkMath.h"

#include <sstream>

using namespace filtertesting;

namespace
{

/// Edges with one triangle or more than two.
vtkIdType countFeatureEdges(vtkPolyData* surface)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->FeatureEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

/// The enclosed volume: negative, since triangles face decreasing values inside.
double volumeOf(vtkPolyData* surface)
{
  double sum = 0.0;
  for (const auto& [a, b, c] : trianglesOf(surface))
  {
    const Vector across = analytic::cross(placeOf(surface, b), placeOf(surface, c));
    sum += dot(placeOf(surface, a), across) / 6.0;
  }
  return sum;
}

} // namespace

TEST(IsosurfaceFilter, YieldsAClosedSurface)
{
  const auto filter = newFilter<Isosurface>(newCloud(100000));
  EXPECT_TRUE(filter->GetRegularize());
  const auto errors = watchErrors(filter);
  vtkIdType all = 0;
  for (const bool regularizes : { false, true })
  {
    SCOPED_TRACE(regularizes);
    filter->SetRegularize(regularizes);
    vtkPolyData* const surface = outputOf(filter);
    EXPECT_EQ(errors->count(), 0u);
    all = regularizes ? all : surface->GetNumberOfPolys();
    ASSERT_GT(all, 10000);
    ASSERT_GT(surface->GetNumberOfPolys(), regularizes ? all / 6 : 0);
    ASSERT_LT(surface->GetNumberOfPolys(), regularizes ? all / 2 : all + 1);
    ASSERT_GT(surface->GetNumberOfPolys(), 5000);
    EXPECT_EQ(surface->GetNumberOfVerts(), 0);
    EXPECT_EQ(surface->GetNumberOfPoints() - surface->GetNumberOfPolys() / 2, 2); // Euler
    EXPECT_EQ(countFeatureEdges(surface), 0);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const Vector p = placeOf(surface, i);
      EXPECT_NEAR(length(p), 0.7, 1e-3);
      EXPECT_LT(dot(p, tupleOf(surface->GetPointData()->GetNormals(), i)), -0.69);
      EXPECT_NEAR(findArray(surface, "x")->GetComponent(i, 0), p[0], 0.02);
      EXPECT_EQ(findArray(surface, "distance")->GetComponent(i, 0), 0.7);
    }
    EXPECT_EQ(findArray(surface, "Radius"), nullptr);
    EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), 0);
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);
  }
  std::ostringstream printed;
  filter->Print(printed);
  expectContains(printed.str(), "Regularize: On");
}

TEST(IsosurfaceFilter, HasTheVolumeAndAreaOfTheSphere)
{
  const auto filter = newFilter<Isosurface>(newCloud(400000));
  EXPECT_TRUE(filter->GetDropGaps());
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(filter->GetOutputPort());
  mass->Update();
  EXPECT_NEAR(mass->GetVolume() / (4.0 / 3.0 * vtkMath::Pi() * 0.343), 1.0, 0.001);
  EXPECT_NEAR(mass->GetSurfaceArea() / (4.0 * vtkMath::Pi() * 0.49), 1.0, 0.001);
}

// The surface and its orientation are those of vtkContourFilter on VTK's own tetrahedra.
TEST(IsosurfaceFilter, AgreesWithContourOnTetrahedra)
{
  const auto cloud = newCloud(800, VTK_DOUBLE);
  vtkNew<vtkDelaunay3D> tetrahedra;
  tetrahedra->SetInputData(cloud);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(tetrahedra->GetOutputPort());
  contour->SetValue(0, 0.7);
  contour->Update();
  const auto filter = newFilter<Isosurface>(cloud);
  filter->SetProjection(Isopoints::NO_PROJECTION);
  filter->RegularizeOff();
  EXPECT_LT(volumeOf(outputOf(filter)), -1.0);
  EXPECT_NEAR(volumeOf(filter->GetOutput()), volumeOf(contour->GetOutput()), 1e-3);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), contour->GetOutput()->GetNumberOfPoints());
}

TEST(IsosurfaceFilter, HasNormalsOfTriangles)
{
  const auto filter = newFilter<Isosurface>(newCloud(30000));
  filter->SetProjection(Isopoints::NO_PROJECTION);
  filter->SetNormalMethod(Isopoints::NORMALS_FROM_PLANES);
  vtkPolyData* const surface = outputOf(filter);
  EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    EXPECT_LT(dot(placeOf(surface, i), tupleOf(findArray(surface, "Normals"), i)), -0.35);
  }
}
