// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive grids: AMR and hyper trees.
#include "InputTesting.h"

#include "Input/vtkIsopointCompatibility.h"
#include "vtkStructuredData.h"

#include <cmath>

using namespace inputtesting;

namespace
{

/// Gives an AMR this many grids in each level.
void initializeLevels(vtkUniformGridAMR* amr, const std::vector<unsigned int>& grids)
{
  vtkCallNewer(
    amr, [&](auto* any) -> decltype(any->Initialize(grids)) { return any->Initialize(grids); },
    [&](auto* any)
    {
      any->Initialize(
        static_cast<int>(grids.size()), std::vector<int>(grids.begin(), grids.end()).data());
    });
}

/// Two levels: a coarse box and a fine one over its lower half along x. The values of both are
/// those of one field.
vtkSmartPointer<vtkOverlappingAMR> newOverlapping()
{
  auto amr = vtkSmartPointer<vtkOverlappingAMR>::New();
  initializeLevels(amr, { 1, 1 });
  const double origin[3] = { -1.0, -1.0, -1.0 };
  amr->SetOrigin(origin);
  const auto coarse = newImage<vtkUniformGrid>(8, 0.25, -1.0, -1.0, -1.0);
  amr->SetGridDescription(vtkStructuredData::GetDataDescription(coarse->GetDimensions()));
  vtkNew<vtkUniformGrid> fine;
  fine->SetDimensions(9, 17, 17);
  fine->SetSpacing(0.125, 0.125, 0.125);
  fine->SetOrigin(-1.0, -1.0, -1.0);
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkUniformGrid* const grid = level == 0 ? coarse.Get() : fine.Get();
    addCellField(grid);
    addPointField(grid);
    double spacing[3];
    grid->GetSpacing(spacing);
    amr->SetSpacing(level, spacing);
    vtkAMRBox box(grid->GetOrigin(), grid->GetDimensions(), grid->GetSpacing(), origin);
    amr->SetAMRBox(level, 0, box);
    amr->SetDataSet(level, 0, grid);
  }
  const auto ghosts = newGhosts(coarse->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < coarse->GetNumberOfCells(); ++cell)
  {
    ghosts->SetValue(cell, cell % 8 < 4 ? vtkDataSetAttributes::REFINEDCELL : 0);
  }
  coarse->GetCellData()->AddArray(ghosts);
  return amr;
}

} // namespace

TEST(Trees, OverlappingAmrHasOneSampleAtEachPlace)
{
  const auto amr = newOverlapping();
  Samples cells;
  Samples points;
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkDataSet* const grid = vtkGetGridOfLevel(amr, level, 0);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      if (level == 1 || cell % 8 >= 4)
      {
        cells.add(meanOfCorners(grid, cell).data(),
          grid->GetCellData()->GetArray("f")->GetComponent(cell, 0));
      }
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      if (level == 1 || i % 9 >= 4)
      {
        points.add(grid->GetPoint(i), fieldAt(grid->GetPoint(i)));
      }
    }
  }
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS, cells);
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_POINTS, points);

  const auto filter = newFilter(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  filter->ContourBlocksOn();
  filter->Update();
  auto* const levels = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(levels);
  ASSERT_EQ(levels->GetNumberOfBlocks(), 2u);
  for (unsigned int level = 0; level < 2; ++level)
  {
    auto* const boxes = vtkMultiBlockDataSet::SafeDownCast(levels->GetBlock(level));
    ASSERT_TRUE(boxes);
    const auto alone =
      newFilter(vtkGetGridOfLevel(amr, level, 0), vtkDataObject::FIELD_ASSOCIATION_CELLS);
    alone->Update();
    EXPECT_GT(alone->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(everythingOf(vtkPolyData::SafeDownCast(boxes->GetBlock(0))),
      everythingOf(alone->GetOutput()));
  }
}

TEST(Trees, NonOverlappingAmr)
{
  vtkNew<vtkNonOverlappingAMR> amr;
  initializeLevels(amr, { 1, 2 });
  amr->SetDataSet(0, 0, newImage<vtkUniformGrid>(8, 0.25, -1.0, -1.0, -1.0));
  amr->SetDataSet(1, 1, newImage<vtkUniformGrid>(8, 0.125, 1.0, -1.0, -1.0)); // one box is missing
  Samples samples;
  for (unsigned int level = 0; level < 2; ++level)
  {
    vtkDataSet* const grid = vtkGetGridOfLevel(amr, level, level);
    addCellField(grid);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      samples.add(meanOfCorners(grid, cell).data(),
        grid->GetCellData()->GetArray("f")->GetComponent(cell, 0));
    }
  }
  expectSame(amr, vtkDataObject::FIELD_ASSOCIATION_CELLS, samples);
}

namespace
{

/// Hyper trees of one to three levels. Nodes that are not leaves have values out of the field's
/// range, which must not be used.
vtkSmartPointer<vtkHyperTreeGrid> newTrees(Samples& leaves, bool withMaskAndGhosts)
{
  vtkSmartPointer<vtkHyperTreeGrid> trees = inputtesting::newHyperTreeGrid();
  vtkIdType offset = 0;
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SetGlobalIndexStart(offset);
    if (tree % 3 != 0)
    {
      cursor->SubdivideLeaf();
      cursor->ToChild(static_cast<unsigned char>(tree % 8));
      cursor->SubdivideLeaf();
      cursor->ToParent();
    }
    offset += cursor->GetTree()->GetNumberOfVertices();
  }
  const auto f = newArray<vtkDoubleArray>("f", offset);
  f->Fill(1e6);
  const auto ghosts = newGhosts(offset);
  vtkNew<vtkBitArray> mask;
  mask->SetNumberOfValues(offset);
  for (vtkIdType id = 0; id < offset; ++id)
  {
    mask->SetValue(id, 0);
  }
  const std::function<void(vtkHyperTreeGridNonOrientedGeometryCursor*)> visit =
    [&](vtkHyperTreeGridNonOrientedGeometryCursor* cursor)
  {
    const vtkIdType id = cursor->GetGlobalNodeIndex();
    if (!cursor->IsLeaf())
    {
      if (withMaskAndGhosts && id % 5 == 1)
      {
        mask->SetValue(id, 1); // and with it all leaves below
        return;
      }
      for (unsigned char child = 0; child < cursor->GetNumberOfChildren(); ++child)
      {
        cursor->ToChild(child);
        visit(cursor);
        cursor->ToParent();
      }
      return;
    }
    double center[3];
    cursor->GetPoint(center);
    f->SetValue(id, fieldAt(center));
    if (withMaskAndGhosts && (id % 7 == 3 || id % 11 == 4))
    {
      id % 7 == 3 ? mask->SetValue(id, 1) : ghosts->SetValue(id, 1);
      return;
    }
    leaves.add(center, fieldAt(center));
  };
  for (vtkIdType tree = 0; tree < 64; ++tree)
  {
    vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
    trees->InitializeNonOrientedGeometryCursor(cursor, tree);
    visit(cursor);
  }
  if (withMaskAndGhosts)
  {
    trees->SetMask(mask);
    trees->GetCellData()->AddArray(ghosts);
  }
  trees->GetCellData()->SetScalars(f);
  return trees;
}

} // namespace

TEST(Trees, LeavesOfHyperTrees)
{
  for (const bool withMaskAndGhosts : { false, true })
  {
    SCOPED_TRACE(withMaskAndGhosts);
    Samples leaves;
    const auto trees = newTrees(leaves, withMaskAndGhosts);
    const auto expected = newFilter(cloudOf(leaves));
    expected->Update();
    const auto filter = newFilter(trees, vtkDataObject::FIELD_ASSOCIATION_CELLS);
    filter->Update();
    // Nodes that are not leaves take ids, too, so that ids and with them the order of points
    // differ.
    const auto sorted = [](vtkPolyData* output)
    {
      std::vector<std::array<double, 3>> points(
        static_cast<std::size_t>(output->GetNumberOfPoints()));
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        output->GetPoint(static_cast<vtkIdType>(i), points[i].data());
        for (double& coordinate : points[i])
        {
          coordinate = 1e-10 * std::round(1e10 * coordinate); // fits sum samples in order of ids
        }
      }
      std::sort(points.begin(), points.end());
      return points;
    };
    ASSERT_EQ(sorted(filter->GetOutput()).size(), sorted(expected->GetOutput()).size());
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 20);
    const auto found = sorted(filter->GetOutput());
    const auto wanted = sorted(expected->GetOutput());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(found[i][axis], wanted[i][axis], 2e-10);
      }
    }
    const vtkIdType leafCount = trees->GetNumberOfLeaves();
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(),
      leafCount - static_cast<vtkIdType>(leaves.values.size()));

    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, trees);
    const auto inBlocks = newFilter(blocks, vtkDataObject::FIELD_ASSOCIATION_CELLS);
    inBlocks->Update();
    EXPECT_EQ(everythingOf(inBlocks->GetOutput()), everythingOf(filter->GetOutput()));
  }
}
