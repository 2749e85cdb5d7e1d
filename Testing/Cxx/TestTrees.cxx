// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive grids: AMR and hyper trees.
#include "InputTesting.h"

#include "Common/vtkIsopointCompatibility.h"

#include "vtkAMRBox.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkNonOverlappingAMR.h"
#include "vtkOverlappingAMR.h"
#include "vtkStructuredData.h"

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
  amr->SetGridDescription(VTK_XYZ_GRID);
  for (unsigned int level = 0; level < 2; ++level)
  {
    const auto grid = level == 0 ? newImage<vtkUniformGrid>({ 8, 8, 8 }, 0.25)
                                 : newImage<vtkUniformGrid>({ 8, 16, 16 }, 0.125);
    addField(grid, ofCells);
    addField(grid, ofPoints);
    if (level == 0)
    {
      grid->GetCellData()->AddArray(
        ghostsOf(8 * 8 * 8, [](vtkIdType cell) { return cell % 8 < 4 ? refined : 0; }));
    }
    amr->SetSpacing(level, grid->GetSpacing());
    amr->SetAMRBox(
      level, 0, vtkAMRBox(grid->GetOrigin(), grid->GetDimensions(), grid->GetSpacing(), origin));
    amr->SetDataSet(level, 0, grid);
  }
  return amr;
}

} // namespace

TEST(Trees, OverlappingAmrHasOneSampleAtEachPlace)
{
  const auto amr = newOverlapping();
  vtkDataSet* const fine = vtkGetGridOfLevel(amr, 1, 0);
  vtkDataSet* const coarse = vtkGetGridOfLevel(amr, 0, 0);
  for (const int association : { ofPoints, ofCells })
  {
    const int length = association == ofPoints ? 9 : 8;
    Samples samples =
      samplesOf(coarse, association, [=](vtkIdType id) { return id % length >= 4; });
    append(samples, samplesOf(fine, association));
    expectSame(amr, association, samples);
  }
  const auto filter = filterOf(amr, ofCells);
  filter->ContourBlocksOn();
  filter->Update();
  auto* const levels = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(levels);
  ASSERT_EQ(levels->GetNumberOfBlocks(), 2u);
  for (unsigned int level = 0; level < 2; ++level)
  {
    auto* const boxes = vtkMultiBlockDataSet::SafeDownCast(levels->GetBlock(level));
    ASSERT_TRUE(boxes);
    const auto alone = filterOf(level == 0 ? coarse : fine, ofCells);
    EXPECT_GT(outputOf(alone)->GetNumberOfPoints(), 0);
    EXPECT_EQ(everythingOf(boxes->GetBlock(0)), everythingOf(alone->GetOutput()));
  }
}

TEST(Trees, NonOverlappingAmr)
{
  vtkNew<vtkNonOverlappingAMR> amr;
  initializeLevels(amr, { 1, 2 }); // one box is missing
  Samples samples;
  for (unsigned int level = 0; level < 2; ++level)
  {
    const auto grid = newImage<vtkUniformGrid>(
      { 8, 8, 8 }, level == 0 ? 0.25 : 0.125, { level == 0 ? -1.0 : 1.0, -1.0, -1.0 });
    addField(grid, ofCells);
    amr->SetDataSet(level, level, grid);
    append(samples, samplesOf(grid, ofCells));
  }
  expectSame(amr, ofCells, samples);
}

namespace
{

/// Hyper trees of one to three levels. Nodes that are not leaves have values out of the field's
/// range, which must not be used.
vtkSmartPointer<vtkHyperTreeGrid> newTrees(Samples& leaves, bool withMaskAndGhosts)
{
  const auto trees = newHyperTreeGrid();
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
  const auto ghosts = ghostsOf(offset, [](vtkIdType) { return 0; });
  const auto mask = newArray<vtkBitArray>("", offset);
  mask->Fill(0.0);
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
    Vector center;
    cursor->GetPoint(center.data());
    f->SetValue(id, fieldAt(center));
    if (withMaskAndGhosts && (id % 7 == 3 || id % 11 == 4))
    {
      id % 7 == 3 ? mask->SetValue(id, 1) : ghosts->SetValue(id, 1);
      return;
    }
    leaves.push_back({ center[0], center[1], center[2], fieldAt(center) });
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

// Nodes that are not leaves have ids, too. So points have another order, and fits, which sum
// samples in the order of ids, are rounded differently.
TEST(Trees, LeavesOfHyperTrees)
{
  const auto sorted = [](vtkPolyData* output)
  {
    std::vector<Vector> points;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      points.push_back(placeOf(output, i));
      std::for_each(points.back().begin(), points.back().end(),
        [](double& coordinate) { coordinate = 1e-10 * std::round(1e10 * coordinate); });
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  for (const bool withMaskAndGhosts : { false, true })
  {
    SCOPED_TRACE(withMaskAndGhosts);
    Samples leaves;
    const auto trees = newTrees(leaves, withMaskAndGhosts);
    const auto filter = filterOf(trees, ofCells);
    const std::vector<Vector> found = sorted(outputOf(filter));
    const std::vector<Vector> expected = sorted(outputOf(filterOf(cloudOf(leaves))));
    EXPECT_GT(found.size(), 20u);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(found[i][axis], expected[i][axis], 2e-10);
      }
    }
    EXPECT_EQ(filter->GetNumberOfSkippedSamples(),
      trees->GetNumberOfLeaves() - static_cast<vtkIdType>(leaves.size()));
    EXPECT_EQ(everythingOf(outputOf(filterOf(blocksOf({ trees }), ofCells))),
      everythingOf(filter->GetOutput()));
  }
}
