// SPDX-License-Identifier: GPL-3.0-or-later
// Points of ghost cells: which of them are samples if only the cells have a ghost array.
#include "InputTesting.h"

#include "vtkObjectFactory.h"

#include <atomic>

using namespace inputtesting;

namespace
{

/// Gives each cell of a box of 8 x 8 x 8 the ghost bits of its index along x.
void addCellGhosts(vtkDataSet* input, const std::array<unsigned char, 8>& bitsAlongX)
{
  const auto ghosts = newGhosts(input->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    ghosts->SetValue(cell, bitsAlongX[static_cast<std::size_t>(cell % 8)]);
  }
  input->GetCellData()->AddArray(ghosts);
}

/// The points of a box of 9 x 9 x 9 that are samples, by their index along x.
Samples samplesAlongX(vtkDataSet* input, const std::array<bool, 9>& isSample)
{
  Samples samples;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    if (isSample[static_cast<std::size_t>(i % 9)])
    {
      samples.add(input->GetPoint(i), fieldAt(input->GetPoint(i)));
    }
  }
  return samples;
}

void expectSkipped(vtkDataSet* input, vtkIdType count)
{
  const auto filter = newFilter(input);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(), count);
}

constexpr unsigned char duplicate = vtkDataSetAttributes::DUPLICATECELL;
constexpr unsigned char hidden = vtkDataSetAttributes::HIDDENCELL;
constexpr unsigned char refined = vtkDataSetAttributes::REFINEDCELL;
constexpr vtkIdType layer = 81; // points of one index along x

/// A grid that counts how often the points of its cells are read, and aborts a filter at a cell.
class CountingGrid : public vtkUnstructuredGrid
{
public:
  static CountingGrid* New();
  vtkTypeMacro(CountingGrid, vtkUnstructuredGrid);

  using vtkUnstructuredGrid::GetCellPoints;
  void GetCellPoints(vtkIdType cell, vtkIdList* points) override
  {
    if (++this->Reads == this->AbortAt)
    {
      this->Aborted->SetAbortExecute(1);
    }
    this->Superclass::GetCellPoints(cell, points);
  }

  std::atomic<vtkIdType> Reads{ 0 };
  vtkIdType AbortAt = -1;
  vtkAlgorithm* Aborted = nullptr;
};

vtkStandardNewMacro(CountingGrid);

/// A box of cells with ghosts on one side, and with arrays of points and cells.
vtkSmartPointer<CountingGrid> newCountingGrid(int cells)
{
  const auto grid = vtkSmartPointer<CountingGrid>::New();
  grid->ShallowCopy(unstructuredOf(newImage(cells, 2.0 / cells, -1.0, -1.0, -1.0)));
  addPointField(grid);
  addCellField(grid);
  const auto ghosts = newGhosts(grid->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < ghosts->GetNumberOfValues(); cell += cells)
  {
    ghosts->SetValue(cell, duplicate);
  }
  grid->GetCellData()->AddArray(ghosts);
  const auto hidden = newGhosts(grid->GetNumberOfPoints());
  hidden->SetValue(5, vtkDataSetAttributes::HIDDENPOINT);
  grid->GetPointData()->AddArray(hidden);
  return grid;
}

} // namespace

TEST(Ghosts, OfPointsAndCellsAreKeptWhileNothingTheyComeFromChanges)
{
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    const auto grid = newCountingGrid(8);
    if (association == vtkDataObject::FIELD_ASSOCIATION_POINTS)
    {
      // Otherwise the ghosts of cells that are duplicates have no say.
      grid->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
    }
    grid->Reads = 0;
    const auto filter = newFilter(grid, association);
    filter->Update();
    EXPECT_GE(grid->Reads, grid->GetNumberOfCells());
    const vtkIdType skipped = filter->GetNumberOfSkippedSamples();
    EXPECT_GT(skipped, 0);
    grid->Reads = 0;
    filter->SetValue(0, isovalue + 0.1);
    filter->Update();
    EXPECT_EQ(grid->Reads, 0);
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), skipped);
    // Blanking changes a flag in place.
    grid->GetCellGhostArray()->SetValue(9, hidden);
    filter->Modified();
    filter->Update();
    EXPECT_GE(grid->Reads, grid->GetNumberOfCells());
    const auto fresh = newFilter(grid, association);
    fresh->SetValue(0, isovalue + 0.1);
    fresh->Update();
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), fresh->GetNumberOfSkippedSamples());
    EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(fresh->GetOutput()));
  }
}

TEST(Ghosts, AnAbortEndsTheSearchForThem)
{
  const auto grid = newCountingGrid(80);
  grid->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  const auto filter = newFilter(grid);
  grid->Aborted = filter;
  grid->Reads = 0;
  grid->AbortAt = 1000;
  filter->Update();
  EXPECT_LT(grid->Reads, grid->GetNumberOfCells());
  expectEmpty(filter->GetOutput());
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Ghosts, PointsOfGhostCellsOnlyAreLeftOutAndCounted)
{
  for (vtkDataSet* const input : everyGrid())
  {
    SCOPED_TRACE(input->GetClassName());
    addPointField(input);
    addCellGhosts(input, { 0, 0, 0, 0, 0, duplicate, duplicate, duplicate });
    const std::array<bool, 9> isSample{ true, true, true, true, true, true, false, false, false };
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_POINTS, samplesAlongX(input, isSample));
    expectSkipped(input, 3 * layer);
  }
}

TEST(Ghosts, PointsOfCellsWithDifferentGhostBitsAreLeftOut)
{
  for (vtkDataSet* const input : everyGrid())
  {
    SCOPED_TRACE(input->GetClassName());
    addPointField(input);
    addCellGhosts(input, { duplicate, hidden, 0, 0, 0, 0, duplicate, refined });
    const std::array<bool, 9> isSample{ false, false, true, true, true, true, true, false, false };
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_POINTS, samplesAlongX(input, isSample));
    expectSkipped(input, 4 * layer);
  }
}

TEST(Ghosts, AGhostArrayOfThePointsDeterminesTheDuplicates)
{
  for (vtkDataSet* const input : everyGrid())
  {
    SCOPED_TRACE(input->GetClassName());
    addPointField(input);
    addCellGhosts(input, { duplicate, duplicate, 0, 0, 0, duplicate, hidden, hidden });
    const auto ghosts = newGhosts(input->GetNumberOfPoints());
    for (vtkIdType i = 0; i < input->GetNumberOfPoints(); i += 9)
    {
      ghosts->SetValue(i, vtkDataSetAttributes::DUPLICATEPOINT);
    }
    input->GetPointData()->AddArray(ghosts);
    const std::array<bool, 9> isSample{ false, true, true, true, true, true, true, false, false };
    expectSame(input, vtkDataObject::FIELD_ASSOCIATION_POINTS, samplesAlongX(input, isSample));
    expectSkipped(input, 3 * layer);
  }
}

TEST(Ghosts, PointsOfNoCellAreSamples)
{
  const auto grid = unstructuredOf(newImage(8, 0.25, -1.0, -1.0, -1.0));
  addCellGhosts(grid,
    { duplicate, duplicate, duplicate, duplicate, duplicate, duplicate, duplicate, duplicate });
  Samples samples;
  const auto cloud = newCloud(1000, VTK_DOUBLE);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    grid->GetPoints()->InsertNextPoint(cloud->GetPoint(i));
    samples.add(cloud->GetPoint(i), fieldAt(cloud->GetPoint(i)));
  }
  addPointField(grid);
  expectSame(grid, vtkDataObject::FIELD_ASSOCIATION_POINTS, samples);
  expectSkipped(grid, 9 * layer);
}
