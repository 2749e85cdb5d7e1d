// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef InputTesting_h
#define InputTesting_h

#include "FilterTesting.h"

#include "vtkAMRBox.h"
#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellCenters.h"
#include "vtkCellData.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkOverlappingAMR.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <limits>

/// Shared by the tests of the filter's inputs: data sets of every kind, and the samples that they
/// represent.
namespace inputtesting
{

using namespace filtertesting;

constexpr double isovalue = 0.3;

inline double fieldAt(const double p[3])
{
  return p[0] * p[0] + 0.7 * p[1] + 0.3 * p[2] * p[2] * p[0];
}

/// Samples that a test composes, in the order of their ids.
struct Samples
{
  std::vector<std::array<double, 3>> positions;
  std::vector<double> values;

  void add(const double p[3], double value)
  {
    this->positions.push_back({ p[0], p[1], p[2] });
    this->values.push_back(value);
  }
};

inline vtkSmartPointer<vtkPolyData> cloudOf(const Samples& samples)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto f = newArray<vtkDoubleArray>("f", static_cast<vtkIdType>(samples.values.size()));
  for (std::size_t i = 0; i < samples.values.size(); ++i)
  {
    points->InsertNextPoint(samples.positions[i].data());
    f->SetValue(static_cast<vtkIdType>(i), samples.values[i]);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(f);
  return cloud;
}

/// A grid of 4 x 4 x 4 hyper trees between -1 and 1, without nodes yet.
inline vtkSmartPointer<vtkHyperTreeGrid> newHyperTreeGrid()
{
  auto trees = vtkSmartPointer<vtkHyperTreeGrid>::New();
  trees->SetDimensions(5, 5, 5);
  trees->SetBranchFactor(2);
  vtkNew<vtkDoubleArray> coordinates;
  for (int i = 0; i < 5; ++i)
  {
    coordinates->InsertNextValue(-1.0 + 0.5 * i);
  }
  trees->SetXCoordinates(coordinates);
  trees->SetYCoordinates(coordinates);
  trees->SetZCoordinates(coordinates);
  return trees;
}

/// Positions, normals, radii and scalars of a surface.
inline std::vector<double> everythingOf(vtkPolyData* output)
{
  std::vector<double> all = pointsOf(output);
  for (const char* const name : { "f", "Normals", "Radius" })
  {
    vtkDataArray* const array = output->GetPointData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        all.push_back(array->GetComponent(i, c));
      }
    }
  }
  return all;
}

inline vtkNew<vtkScatteredIsopointFilter> newFilter(
  vtkDataObject* input, int association = vtkDataObject::FIELD_ASSOCIATION_POINTS)
{
  vtkNew<vtkScatteredIsopointFilter> filter;
  filter->SetInputData(input);
  filter->SetValue(0, isovalue);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetInputArrayToProcess(0, 0, 0, association, "f");
  return filter;
}

/// Expects the same output, to the last bit, from the input as from the samples.
inline void expectSame(vtkDataObject* input, int association, const Samples& samples)
{
  const auto expected = newFilter(cloudOf(samples));
  expected->Update();
  EXPECT_GT(expected->GetOutput()->GetNumberOfPoints(), 20);
  const auto filter = newFilter(input, association);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->Count, 0) << errors->Last;
  ASSERT_TRUE(filter->GetOutput());
  EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(expected->GetOutput()));
}

inline void addPointField(vtkDataSet* input)
{
  const auto f = newArray<vtkDoubleArray>("f", input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    f->SetValue(i, fieldAt(input->GetPoint(i)));
  }
  input->GetPointData()->AddArray(f);
}

inline Samples pointSamples(vtkDataSet* input)
{
  Samples samples;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    samples.add(input->GetPoint(i), input->GetPointData()->GetArray("f")->GetComponent(i, 0));
  }
  return samples;
}

inline void append(Samples& samples, const Samples& more)
{
  samples.positions.insert(samples.positions.end(), more.positions.begin(), more.positions.end());
  samples.values.insert(samples.values.end(), more.values.begin(), more.values.end());
}

/// The mean of a cell's corners: its center, for boxes and for tetrahedra alike.
inline std::array<double, 3> meanOfCorners(vtkDataSet* input, vtkIdType cell)
{
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(cell, corners);
  std::array<double, 3> mean{};
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] +=
        input->GetPoint(corners->GetId(i))[axis] / static_cast<double>(corners->GetNumberOfIds());
    }
  }
  return mean;
}

inline void addCellField(vtkDataSet* input)
{
  const auto f = newArray<vtkDoubleArray>("f", input->GetNumberOfCells());
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    f->SetValue(i, fieldAt(meanOfCorners(input, i).data()));
  }
  input->GetCellData()->AddArray(f);
}

inline vtkSmartPointer<vtkUnsignedCharArray> newGhosts(vtkIdType count)
{
  const auto ghosts = newArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), count);
  ghosts->Fill(0);
  return ghosts;
}

/// A box of cells of side `spacing`. All coordinates are exact, so that a position computed in
/// another way is the same to the last bit.
template <class TImage = vtkImageData>
inline vtkSmartPointer<TImage> newImage(int cells, double spacing, double x, double y, double z)
{
  auto image = vtkSmartPointer<TImage>::New();
  image->SetDimensions(cells + 1, cells + 1, cells + 1);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(x, y, z);
  return image;
}

inline vtkSmartPointer<vtkRectilinearGrid> rectilinearOf(vtkImageData* image)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(image->GetDimensions());
  vtkNew<vtkDoubleArray> coordinates[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < image->GetDimensions()[axis]; ++i)
    {
      coordinates[axis]->InsertNextValue(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
    }
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  return grid;
}

inline vtkSmartPointer<vtkPoints> pointsOfDataSet(vtkDataSet* input)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(input->GetPoint(i));
  }
  return points;
}

inline vtkSmartPointer<vtkUnstructuredGrid> unstructuredOf(vtkDataSet* input)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(pointsOfDataSet(input));
  grid->Allocate(input->GetNumberOfCells());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    input->GetCellPoints(cell, corners);
    grid->InsertNextCell(input->GetCellType(cell), corners);
  }
  return grid;
}

/// The same box of cells as every kind of data set with cells.
inline std::vector<vtkSmartPointer<vtkDataSet>> everyGrid()
{
  const auto image = newImage(8, 0.25, -1.0, -1.0, -1.0);
  auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
  structured->SetDimensions(image->GetDimensions());
  structured->SetPoints(pointsOfDataSet(image));
  const auto unstructured = unstructuredOf(image);
  auto explicitGrid = vtkSmartPointer<vtkExplicitStructuredGrid>::New();
  explicitGrid->SetExtent(0, 8, 0, 8, 0, 8);
  explicitGrid->SetPoints(pointsOfDataSet(image));
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> corners;
    image->GetCellPoints(cell, corners);
    const vtkIdType ring[8] = { corners->GetId(0), corners->GetId(1), corners->GetId(3),
      corners->GetId(2), corners->GetId(4), corners->GetId(5), corners->GetId(7),
      corners->GetId(6) };
    cells->InsertNextCell(8, ring);
  }
  explicitGrid->SetCells(cells);
  explicitGrid->ComputeFacesConnectivityFlagsArray();
  auto uniform = vtkSmartPointer<vtkUniformGrid>::New();
  uniform->ShallowCopy(image);
  return { image, rectilinearOf(image), structured, unstructured, explicitGrid, uniform };
}

} // namespace inputtesting

#endif
