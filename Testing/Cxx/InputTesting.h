// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "FilterTesting.h"

#include "vtkBitArray.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedCursor.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUniformGrid.h"

/// Shared by the tests of the filter's inputs: data sets of every kind, and the samples that they
/// represent.
namespace inputtesting
{

using namespace filtertesting;

constexpr unsigned char duplicate = vtkDataSetAttributes::DUPLICATECELL;
constexpr unsigned char hidden = vtkDataSetAttributes::HIDDENCELL;
constexpr unsigned char refined = vtkDataSetAttributes::REFINEDCELL;
constexpr unsigned char duplicatePoint = vtkDataSetAttributes::DUPLICATEPOINT;
constexpr unsigned char hiddenPoint = vtkDataSetAttributes::HIDDENPOINT;

inline double fieldAt(const Vector& p)
{
  return p[0] * p[0] + 0.7 * p[1] + 0.3 * p[2] * p[2] * p[0];
}

/// A point or, of boxes and tetrahedra, the center of a cell.
inline Vector placeOfSample(vtkDataSet* input, int association, vtkIdType id)
{
  if (association == ofPoints)
  {
    return placeOf(input, id);
  }
  vtkNew<vtkIdList> corners;
  input->GetCellPoints(id, corners);
  Vector mean{};
  for (const vtkIdType corner : *corners)
  {
    const auto count = static_cast<double>(corners->GetNumberOfIds());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] += input->GetPoint(corner)[axis] / count;
    }
  }
  return mean;
}

/// The samples, with the values of the field, whose ids a test accepts.
inline Samples samplesOf(
  vtkDataSet* input, int association, const std::function<bool(vtkIdType)>& isSample = {})
{
  Samples samples;
  for (vtkIdType id = 0; id < input->GetNumberOfElements(association); ++id)
  {
    if (!isSample || isSample(id))
    {
      const Vector p = placeOfSample(input, association, id);
      samples.push_back({ p[0], p[1], p[2], fieldAt(p) });
    }
  }
  return samples;
}

inline void append(Samples& samples, const Samples& more)
{
  samples.insert(samples.end(), more.begin(), more.end());
}

/// Adds the field as an array "f" of the points or cells.
inline void addField(vtkDataSet* input, int association)
{
  input->GetAttributes(association)
    ->AddArray(arrayOf("f", input->GetNumberOfElements(association),
      [&](vtkIdType id) { return fieldAt(placeOfSample(input, association, id)); }));
}

/// Adds scalars that do not depend on positions.
inline void addScatteredField(vtkDataObject* input, int association, vtkIdType count)
{
  input->GetAttributes(association)
    ->SetScalars(
      arrayOf("f", count, [](vtkIdType i) { return static_cast<double>((i * 37) % 101) / 101.0; }));
}

/// A filter of the array "f".
template <class TFilter = Isopoints>
vtkSmartPointer<TFilter> filterOf(vtkDataObject* input, int association = ofPoints)
{
  const auto filter = newFilter<TFilter>(input, 0.3);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetInputArrayToProcess(0, 0, 0, association, "f");
  return filter;
}

/// Expects the same output, to the last bit, from the input as from the samples.
inline void expectSame(vtkDataObject* input, int association, const Samples& samples)
{
  const auto expected = filterOf(cloudOf(samples));
  EXPECT_GT(outputOf(expected)->GetNumberOfPoints(), 20);
  const auto filter = filterOf(input, association);
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->count(), 0u) << errors->last();
  ASSERT_TRUE(filter->GetOutput());
  EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(expected->GetOutput()));
}

inline vtkSmartPointer<vtkDoubleArray> newCoordinates(int count, double first, double spacing)
{
  return arrayOf("", count, [&](vtkIdType i) { return first + static_cast<double>(i) * spacing; });
}

/// A grid of 4 x 4 x 4 hyper trees between -1 and 1, without nodes yet.
inline vtkSmartPointer<vtkHyperTreeGrid> newHyperTreeGrid()
{
  auto trees = vtkSmartPointer<vtkHyperTreeGrid>::New();
  trees->SetDimensions(5, 5, 5);
  trees->SetBranchFactor(2);
  trees->SetXCoordinates(newCoordinates(5, -1.0, 0.5));
  trees->SetYCoordinates(newCoordinates(5, -1.0, 0.5));
  trees->SetZCoordinates(newCoordinates(5, -1.0, 0.5));
  return trees;
}

/// A box of cells. With a spacing that is a power of two all coordinates are exact, so that a
/// position computed in another way is the same to the last bit.
template <class TImage = vtkImageData>
inline vtkSmartPointer<TImage> newImage(
  const std::array<int, 3>& cells, double spacing, const Vector& origin = { -1.0, -1.0, -1.0 })
{
  auto image = vtkSmartPointer<TImage>::New();
  image->SetDimensions(cells[0] + 1, cells[1] + 1, cells[2] + 1);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(origin[0], origin[1], origin[2]);
  return image;
}

inline vtkSmartPointer<vtkRectilinearGrid> rectilinearOf(vtkImageData* image)
{
  const auto coordinates = [image](int axis)
  {
    return newCoordinates(
      image->GetDimensions()[axis], image->GetOrigin()[axis], image->GetSpacing()[axis]);
  };
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(image->GetDimensions());
  grid->SetXCoordinates(coordinates(0));
  grid->SetYCoordinates(coordinates(1));
  grid->SetZCoordinates(coordinates(2));
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

inline vtkSmartPointer<vtkStructuredGrid> structuredOf(vtkImageData* image)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(image->GetDimensions());
  grid->SetPoints(pointsOfDataSet(image));
  return grid;
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

inline vtkSmartPointer<vtkExplicitStructuredGrid> explicitOf(vtkImageData* image)
{
  auto grid = vtkSmartPointer<vtkExplicitStructuredGrid>::New();
  grid->SetExtent(image->GetExtent());
  grid->SetPoints(pointsOfDataSet(image));
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    image->GetCellPoints(cell, corners);
    std::swap(*corners->GetPointer(2), *corners->GetPointer(3));
    std::swap(*corners->GetPointer(6), *corners->GetPointer(7));
    cells->InsertNextCell(corners);
  }
  grid->SetCells(cells);
  return grid;
}

/// The same box of 8 x 7 x 6 cells as every kind of data set with cells.
inline std::vector<vtkSmartPointer<vtkDataSet>> everyGrid(double spacing = 0.25)
{
  const auto image = newImage({ 8, 7, 6 }, spacing);
  return { image, rectilinearOf(image), structuredOf(image), unstructuredOf(image),
    explicitOf(image), newImage<vtkUniformGrid>({ 8, 7, 6 }, spacing) };
}

/// Calls visit(samples, cloud) with the array "f" at the points, and at the cells, of every grid,
/// and with a cloud of the same samples.
template <class Visit>
void forEachGridAndCloud(const Visit& visit)
{
  for (const vtkSmartPointer<vtkDataSet>& grid : everyGrid())
  {
    SCOPED_TRACE(grid->GetClassName());
    for (const int association : { ofPoints, ofCells })
    {
      const vtkSmartPointer<vtkDataSet> samples =
        vtkSmartPointer<vtkDataSet>::Take(grid->NewInstance());
      samples->CopyStructure(grid);
      addField(samples, association);
      visit(samples, cloudOf(samplesOf(grid, association)));
    }
  }
}

/// newCloud() with samples to skip at its end: a duplicate at `first`, and hidden points behind it.
inline vtkSmartPointer<vtkPolyData> newCloudWithGhosts(
  vtkIdType count, vtkIdType first, int pointType = VTK_FLOAT)
{
  const auto cloud = newCloud(count, pointType);
  cloud->GetPointData()->AddArray(ghostsOf(
    count, [&](vtkIdType i) { return i < first    ? 0
                                     : i == first ? duplicatePoint
                                                  : hiddenPoint; }));
  return cloud;
}

/// Updates a filter of surfaces without an error.
inline vtkPolyData* updated(vtkScatteredSurfaceFilter* filter)
{
  const auto errors = watchErrors(filter);
  filter->Update();
  EXPECT_EQ(errors->count(), 0u) << errors->last();
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  return filter->GetOutput();
}

/// Expects the surface of a new filter, of more than so many numbers, and that it is kept.
inline void expectAsNew(
  vtkScatteredSurfaceFilter* filter, vtkScatteredSurfaceFilter* fresh, std::size_t least)
{
  const std::vector<double> all = everythingOf(updated(filter));
  EXPECT_GT(all.size(), least);
  EXPECT_EQ(all, everythingOf(updated(fresh)));
  const vtkMTimeType time = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), time);
}

} // namespace inputtesting
