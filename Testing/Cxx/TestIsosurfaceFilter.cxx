// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of triangles: what it shares with the filter of points, and what it does not.
#include "FilterTesting.h"

#include "vtkScatteredIsosurfaceFilter.h"

#include "vtkCellArray.h"
#include "vtkContourFilter.h"
#include "vtkDecimatePro.h"
#include "vtkDelaunay3D.h"
#include "vtkFeatureEdges.h"
#include "vtkIdList.h"
#include "vtkMassProperties.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSTLWriter.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>
#include <string>

namespace
{

using filtertesting::newArray;
using filtertesting::newCloud;
using filtertesting::pointsOf;
using filtertesting::watchErrors;

vtkSmartPointer<vtkScatteredIsosurfaceFilter> newFilter(vtkDataObject* input, double isovalue)
{
  auto filter = vtkSmartPointer<vtkScatteredIsosurfaceFilter>::New();
  filter->SetInputDataObject(input);
  filter->SetValue(0, isovalue);
  return filter;
}

std::vector<vtkIdType> trianglesOf(vtkPolyData* output)
{
  std::vector<vtkIdType> ids;
  vtkNew<vtkIdList> corners;
  vtkCellArray* const polygons = output->GetPolys();
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    polygons->GetCellAtId(i, corners);
    EXPECT_EQ(corners->GetNumberOfIds(), 3);
    ids.insert(ids.end(), corners->begin(), corners->end());
  }
  return ids;
}

vtkIdType countFeatureEdges(vtkPolyData* surface)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

} // namespace

TEST(IsosurfaceFilter, YieldsAClosedSurface)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(100000);
  for (const bool regularizes : { false, true })
  {
    SCOPED_TRACE(regularizes);
    const auto filter = newFilter(cloud, 0.7);
    filter->SetRegularize(regularizes);
    const auto errors = watchErrors(filter);
    filter->Update();
    EXPECT_EQ(errors->Count, 0);
    vtkPolyData* const surface = filter->GetOutput();
    ASSERT_GT(surface->GetNumberOfPolys(), regularizes ? 5000 : 10000);
    EXPECT_EQ(surface->GetNumberOfVerts(), 0);
    EXPECT_EQ(surface->GetNumberOfPoints() - surface->GetNumberOfPolys() / 2, 2); // Euler
    EXPECT_EQ(countFeatureEdges(surface), 0);
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      double p[3];
      surface->GetPoint(i, p);
      EXPECT_NEAR(vtkMath::Norm(p), 0.7, 1e-3);
      double normal[3];
      surface->GetPointData()->GetNormals()->GetTuple(i, normal);
      EXPECT_LT(vtkMath::Dot(p, normal), -0.69);
      EXPECT_NEAR(surface->GetPointData()->GetArray("x")->GetComponent(i, 0), p[0], 0.02);
      EXPECT_EQ(surface->GetPointData()->GetArray("distance")->GetComponent(i, 0), 0.7);
    }
    EXPECT_EQ(surface->GetPointData()->GetArray("Radius"), nullptr);
    EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), 0);
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), 0);
  }
}

TEST(IsosurfaceFilter, RegularizeLeavesFewerTriangles)
{
  const auto filter = newFilter(newCloud(20000), 0.7);
  EXPECT_TRUE(filter->GetRegularize());
  filter->RegularizeOff();
  EXPECT_FALSE(filter->GetRegularize());
  filter->Update();
  const vtkIdType all = filter->GetOutput()->GetNumberOfPolys();
  const vtkMTimeType before = filter->GetMTime();
  filter->RegularizeOff();
  EXPECT_EQ(filter->GetMTime(), before);
  filter->RegularizeOn();
  EXPECT_GT(filter->GetMTime(), before);
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfPolys(), all / 2);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), all / 6);
  std::ostringstream printed;
  filter->Print(printed);
  EXPECT_NE(printed.str().find("Regularize: On"), std::string::npos);
}

TEST(IsosurfaceFilter, ServesFiltersOfMeshes)
{
  const auto filter = newFilter(newCloud(400000), 0.7);
  filter->Update();
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(filter->GetOutputPort());
  mass->Update();
  const double ball = 4.0 / 3.0 * vtkMath::Pi() * 0.343;
  EXPECT_NEAR(mass->GetVolume(), ball, 0.001 * ball);
  EXPECT_NEAR(
    mass->GetSurfaceArea(), 4.0 * vtkMath::Pi() * 0.49, 0.001 * 4.0 * vtkMath::Pi() * 0.49);
  vtkNew<vtkDecimatePro> decimation;
  decimation->SetInputConnection(filter->GetOutputPort());
  decimation->SetTargetReduction(0.8);
  decimation->PreserveTopologyOn();
  decimation->Update();
  EXPECT_LT(
    decimation->GetOutput()->GetNumberOfPolys(), filter->GetOutput()->GetNumberOfPolys() / 3);
  EXPECT_EQ(countFeatureEdges(decimation->GetOutput()), 0);
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputConnection(filter->GetOutputPort());
  const std::string path = testing::TempDir() + "IsosurfaceFilter.stl";
  writer->SetFileName(path.c_str());
  writer->SetFileTypeToBinary();
  EXPECT_EQ(writer->Write(), 1);
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

/// The triangles look to the same side as those of vtkContourFilter on VTK's own tetrahedra, and
/// the surface is the same.
TEST(IsosurfaceFilter, AgreesWithContourOnTetrahedra)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(800, VTK_DOUBLE);
  vtkNew<vtkDelaunay3D> tetrahedra;
  tetrahedra->SetInputData(cloud);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(tetrahedra->GetOutputPort());
  contour->SetValue(0, 0.7);
  contour->Update();
  const auto filter = newFilter(cloud, 0.7);
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->RegularizeOff();
  filter->Update();
  const auto volumeOf = [](vtkPolyData* surface)
  {
    double sum = 0.0;
    const std::vector<vtkIdType> ids = trianglesOf(surface);
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      double p[3][3];
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        surface->GetPoint(ids[i + corner], p[corner]);
      }
      sum += vtkMath::Determinant3x3(p[0], p[1], p[2]) / 6.0;
    }
    return sum;
  };
  EXPECT_LT(volumeOf(filter->GetOutput()), -1.0);
  EXPECT_NEAR(volumeOf(filter->GetOutput()), volumeOf(contour->GetOutput()), 1e-3);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), contour->GetOutput()->GetNumberOfPoints());
}

TEST(IsosurfaceFilter, TakesSeveralIsovalues)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(30000);
  const auto both = newFilter(cloud, 0.8);
  both->SetValue(1, 0.5);
  both->Update();
  vtkPolyData* const output = both->GetOutput();
  std::vector<vtkIdType> triangles = trianglesOf(output);
  vtkIdType pointCount = 0;
  std::size_t cornerCount = 0;
  for (const double isovalue : { 0.5, 0.8 })
  {
    const auto alone = newFilter(cloud, isovalue);
    alone->Update();
    std::vector<vtkIdType> expected = trianglesOf(alone->GetOutput());
    for (const vtkIdType corner : expected)
    {
      ASSERT_LT(cornerCount, triangles.size());
      ASSERT_EQ(triangles[cornerCount++], corner + pointCount);
    }
    const std::vector<double> positions = pointsOf(alone->GetOutput());
    const std::vector<double> all = pointsOf(output);
    EXPECT_TRUE(std::equal(positions.begin(), positions.end(), all.begin() + 3 * pointCount));
    pointCount += alone->GetOutput()->GetNumberOfPoints();
  }
  EXPECT_EQ(pointCount, output->GetNumberOfPoints());
  EXPECT_EQ(cornerCount, triangles.size());
  EXPECT_EQ(countFeatureEdges(output), 0);
}

TEST(IsosurfaceFilter, ComputesArrays)
{
  const auto filter = newFilter(newCloud(20000), 0.7);
  filter->ComputeNormalsOff();
  filter->ComputeScalarsOff();
  filter->ComputeGradientsOn();
  filter->ComputeProjectionOrdersOn();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  vtkPointData* const data = filter->GetOutput()->GetPointData();
  std::set<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    names.insert(data->GetArrayName(i));
  }
  EXPECT_EQ(names, (std::set<std::string>{ "x", "position", "Gradients", "ProjectionOrder" }));
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  const auto plain = newFilter(newCloud(20000), 0.7);
  plain->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plain->Update();
  EXPECT_EQ(pointsOf(filter->GetOutput()), pointsOf(plain->GetOutput()));
  EXPECT_EQ(countFeatureEdges(filter->GetOutput()), 0);
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double gradient[3];
    filter->GetOutput()->GetPoint(i, p);
    data->GetArray("Gradients")->GetTuple(i, gradient);
    EXPECT_GT(vtkMath::Dot(p, gradient), 0.65);
  }
}

TEST(IsosurfaceFilter, HasNormalsOfTriangles)
{
  const auto filter = newFilter(newCloud(30000), 0.7);
  filter->SetProjection(vtkScatteredIsopointFilter::NO_PROJECTION);
  filter->SetNormalMethod(vtkScatteredIsopointFilter::NORMALS_FROM_PLANES);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfUnprojectedPoints(), filter->GetOutput()->GetNumberOfPoints());
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double normal[3];
    filter->GetOutput()->GetPoint(i, p);
    filter->GetOutput()->GetPointData()->GetNormals()->GetTuple(i, normal);
    EXPECT_LT(vtkMath::Dot(p, normal), -0.5 * 0.7);
  }
}

TEST(IsosurfaceFilter, ContoursBlocks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, newCloud(5000));
  blocks->SetBlock(2, newCloud(8000));
  const auto filter = newFilter(blocks, 0.7);
  filter->ContourBlocksOn();
  filter->Update();
  auto* const output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetBlock(1), nullptr);
  for (const unsigned int block : { 0u, 2u })
  {
    const auto alone = newFilter(blocks->GetBlock(block), 0.7);
    alone->Update();
    auto* const surface = vtkPolyData::SafeDownCast(output->GetBlock(block));
    ASSERT_NE(surface, nullptr);
    EXPECT_EQ(pointsOf(surface), pointsOf(alone->GetOutput()));
    EXPECT_EQ(trianglesOf(surface), trianglesOf(alone->GetOutput()));
    EXPECT_GT(surface->GetNumberOfPolys(), 0);
  }
  filter->ContourBlocksOff();
  filter->Update();
  EXPECT_EQ(countFeatureEdges(filter->GetOutput()), 0);
}

TEST(IsosurfaceFilter, DropsTrianglesAcrossGaps)
{
  const vtkSmartPointer<vtkPolyData> cloud = newCloud(20000);
  auto* const values = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetArray("distance"));
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    values->SetValue(i, p[0] > 0.0 ? p[1] : p[1] + 5.0);
    p[0] += p[0] > 0.0 ? 3.0 : -3.0;
    cloud->GetPoints()->SetPoint(i, p);
  }
  const auto filter = newFilter(cloud, 0.1);
  EXPECT_TRUE(filter->GetDropGaps());
  filter->DropGapsOff();
  filter->Update();
  const vtkIdType all = filter->GetOutput()->GetNumberOfPolys();
  EXPECT_EQ(filter->GetNumberOfDroppedInGaps(), 0);
  filter->DropGapsOn();
  filter->Update();
  EXPECT_GT(filter->GetNumberOfDroppedInGaps(), 0);
  EXPECT_LT(filter->GetOutput()->GetNumberOfPolys(), all);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), all / 4);
}
