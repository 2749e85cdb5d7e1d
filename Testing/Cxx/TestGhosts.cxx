// SPDX-License-Identifier: GPL-3.0-or-later
// Ghost and hidden points and cells: which of them are samples, and when they are found again.
#include "InputTesting.h"

#include "vtkObjectFactory.h"

#include <atomic>

using namespace inputtesting;

namespace
{

/// Expects the accepted samples, and that the others are counted.
void expectSamples(
  vtkDataSet* input, int association, const std::function<bool(vtkIdType)>& isSample)
{
  const Samples samples = samplesOf(input, association, isSample);
  expectSame(input, association, samples);
  const auto filter = filterOf(input, association);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedSamples(),
    input->GetNumberOfElements(association) - static_cast<vtkIdType>(samples.size()));
}

void addGhosts(
  vtkDataSet* input, int association, const std::function<unsigned char(vtkIdType)>& bitsAt)
{
  input->GetAttributes(association)
    ->AddArray(ghostsOf(input->GetNumberOfElements(association), bitsAt));
}

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

/// A box of cells with duplicates on one side, and with arrays of points and cells.
vtkSmartPointer<CountingGrid> newCountingGrid(int cells)
{
  const auto grid = vtkSmartPointer<CountingGrid>::New();
  grid->ShallowCopy(unstructuredOf(newImage({ cells, cells, cells }, 2.0 / cells)));
  addField(grid, ofPoints);
  addField(grid, ofCells);
  addGhosts(grid, ofCells, [cells](vtkIdType cell) { return cell % cells == 0 ? duplicate : 0; });
  return grid;
}

} // namespace

TEST(Ghosts, OfPointsAndCellsAreKeptWhileNothingTheyComeFromChanges)
{
  for (const int association : { ofPoints, ofCells })
  {
    const auto grid = newCountingGrid(8);
    if (association == ofCells) // duplicate cells do not count if points have a ghost array
    {
      addGhosts(grid, ofPoints, [](vtkIdType i) { return i == 5 ? hiddenPoint : 0; });
    }
    grid->Reads = 0;
    const auto filter = filterOf(grid, association);
    filter->Update();
    EXPECT_GE(grid->Reads, grid->GetNumberOfCells());
    const vtkIdType skipped = filter->GetNumberOfSkippedSamples();
    EXPECT_GT(skipped, 0);
    grid->Reads = 0;
    filter->SetValue(0, 0.4);
    filter->Update();
    EXPECT_EQ(grid->Reads, 0);
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), skipped);
    // Blanking changes a flag in place.
    grid->GetCellGhostArray()->SetValue(9, hidden);
    filter->Modified();
    filter->Update();
    EXPECT_GE(grid->Reads, grid->GetNumberOfCells());
    const auto fresh = filterOf(grid, association);
    fresh->SetValue(0, 0.4);
    EXPECT_EQ(everythingOf(filter->GetOutput()), everythingOf(outputOf(fresh)));
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(), fresh->GetNumberOfSkippedSamples());
  }
}

TEST(Ghosts, AnAbortEndsTheSearchForThem)
{
  const auto grid = newCountingGrid(80);
  const auto filter = filterOf(grid);
  grid->Aborted = filter;
  grid->Reads = 0;
  grid->AbortAt = 1000;
  expectEmpty(outputOf(filter));
  EXPECT_LT(grid->Reads, grid->GetNumberOfCells());
  filter->SetAbortExecute(0);
  filter->Modified();
  EXPECT_GT(outputOf(filter)->GetNumberOfPoints(), 0);
}

// Which points of each row along x are samples if the cells of the row have these ghost bits.
TEST(Ghosts, PointsOfGhostCellsOnlyAreLeftOut)
{
  struct Case
  {
    std::array<unsigned char, 8> bitsOfCells;
    bool hasGhostsOfPoints; // the first point is a duplicate, the sixth is hidden
    std::array<bool, 9> areSamples;
  };
  const std::vector<Case> cases{
    { { 0, 0, 0, 0, 0, duplicate, duplicate, duplicate }, false,
      { true, true, true, true, true, true, false, false, false } },
    { { duplicate, hidden, 0, 0, 0, 0, duplicate, refined }, false,
      { false, false, true, true, true, true, true, false, false } },
    { { 0, 0, 0, 0, refined, refined, refined, refined }, false,
      { true, true, true, true, true, false, false, false, false } },
    // A ghost array of the points determines the duplicates.
    { { duplicate, duplicate, 0, 0, 0, duplicate, hidden, hidden }, true,
      { false, true, true, true, true, false, true, false, false } },
  };
  for (const Case& along : cases)
  {
    for (vtkDataSet* const input : everyGrid())
    {
      SCOPED_TRACE(
        testing::Message() << input->GetClassName() << ", case " << &along - cases.data());
      const auto at = [](const auto& values, vtkIdType id)
      { return values[static_cast<std::size_t>(id) % values.size()]; };
      addField(input, ofPoints);
      addGhosts(input, ofCells, [&](vtkIdType cell) { return at(along.bitsOfCells, cell); });
      if (along.hasGhostsOfPoints)
      {
        addGhosts(input, ofPoints,
          [](vtkIdType i) { return i % 9 == 0 ? duplicatePoint : (i % 9 == 5 ? hiddenPoint : 0); });
      }
      expectSamples(input, ofPoints, [&](vtkIdType i) { return at(along.areSamples, i); });
    }
  }
}

TEST(Ghosts, PointsOfNoCellAreSamples)
{
  const auto grid = unstructuredOf(newImage({ 8, 8, 8 }, 0.25));
  const vtkIdType count = grid->GetNumberOfPoints();
  addGhosts(grid, ofCells, [](vtkIdType) { return duplicate; });
  for (const Sample& sample : samplesOf(newCloud(1000, VTK_DOUBLE), ofPoints))
  {
    grid->GetPoints()->InsertNextPoint(sample.data());
  }
  addField(grid, ofPoints);
  expectSamples(grid, ofPoints, [count](vtkIdType i) { return i >= count; });
}

TEST(Ghosts, GhostAndHiddenCellsAreLeftOut)
{
  for (const unsigned char bit : { duplicate, hidden, refined })
  {
    for (vtkDataSet* const input : everyGrid())
    {
      SCOPED_TRACE(testing::Message() << input->GetClassName() << " " << int(bit));
      addField(input, ofCells);
      addGhosts(input, ofCells, [bit](vtkIdType cell) { return cell % 5 == 2 ? bit : 0; });
      expectSamples(input, ofCells, [](vtkIdType cell) { return cell % 5 != 2; });
    }
  }
}

TEST(Ghosts, CellsWithAHiddenPointAreLeftOut)
{
  const auto image = newImage({ 8, 8, 8 }, 0.25);
  addField(image, ofCells);
  addGhosts(image, ofPoints, [](vtkIdType i) { return i == 100 ? hiddenPoint : 0; });
  expectSamples(image, ofCells,
    [&](vtkIdType cell)
    {
      vtkNew<vtkIdList> corners;
      image->GetCellPoints(cell, corners);
      return corners->IsId(100) < 0;
    });
}
