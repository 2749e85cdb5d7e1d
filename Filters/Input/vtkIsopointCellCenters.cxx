// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointCellCenters.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Execution.h"
#include "Core/Failure.h"
#include "Input/vtkIsopointGhosts.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace
{

vtkSmartPointer<vtkDataSet> dualOf(vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  double halfway[3]; // continuous index of the first cell's center, from the first point
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isFlat = extent[2 * axis + 1] <= extent[2 * axis];
    halfway[axis] = isFlat ? 0.0 : 0.5;
    extent[2 * axis + 1] -= isFlat ? 0 : 1;
  }
  double origin[3];
  image->TransformContinuousIndexToPhysicalPoint(halfway, origin);
  auto dual = vtkSmartPointer<vtkImageData>::New();
  dual->SetExtent(extent);
  dual->SetSpacing(image->GetSpacing());
  dual->SetDirectionMatrix(image->GetDirectionMatrix());
  dual->SetOrigin(origin);
  return dual;
}

vtkSmartPointer<vtkDataArray> midpointsOf(vtkDataArray* coordinates)
{
  auto midpoints = vtkSmartPointer<vtkDoubleArray>::New();
  const vtkIdType count = coordinates->GetNumberOfTuples();
  for (vtkIdType i = 0; i + 1 < count; ++i)
  {
    midpoints->InsertNextValue(
      0.5 * coordinates->GetComponent(i, 0) + 0.5 * coordinates->GetComponent(i + 1, 0));
  }
  if (count == 1)
  {
    midpoints->InsertNextValue(coordinates->GetComponent(0, 0));
  }
  return midpoints;
}

vtkSmartPointer<vtkDataSet> dualOf(vtkRectilinearGrid* grid)
{
  auto dual = vtkSmartPointer<vtkRectilinearGrid>::New();
  int dimensions[3];
  grid->GetDimensions(dimensions);
  for (int& dimension : dimensions)
  {
    dimension = std::max(1, dimension - 1);
  }
  dual->SetDimensions(dimensions);
  dual->SetXCoordinates(midpointsOf(grid->GetXCoordinates()));
  dual->SetYCoordinates(midpointsOf(grid->GetYCoordinates()));
  dual->SetZCoordinates(midpointsOf(grid->GetZCoordinates()));
  return dual;
}

class LeafCollector
{
public:
  LeafCollector(const isopoint::Execution& execution, vtkPoints* points,
    vtkUnsignedCharArray* ghosts, vtkUnsignedCharArray* inputGhosts)
    : Run(execution)
    , Points(points)
    , Ghosts(ghosts)
    , InputGhosts(inputGhosts)
  {
  }

  void Collect(vtkHyperTreeGridNonOrientedGeometryCursor* cursor)
  {
    if (cursor->IsMasked())
    {
      // Cursors must not enter masked nodes.
      this->CountLeaves(cursor->GetTree(), cursor->GetVertexId());
      return;
    }
    if (!cursor->IsLeaf())
    {
      for (int child = 0; child < cursor->GetNumberOfChildren(); ++child)
      {
        cursor->ToChild(static_cast<unsigned char>(child));
        this->Collect(cursor);
        cursor->ToParent();
      }
      return;
    }
    const vtkIdType id = cursor->GetGlobalNodeIndex();
    if (!this->IsUsedId(id))
    {
      return;
    }
    constexpr vtkIdType leavesOfStep = 1 << 16;
    if (++this->Leaves % leavesOfStep == 0)
    {
      isopoint::throwIfAborted(this->Run);
    }
    const bool isGhost = this->InputGhosts && this->InputGhosts->GetValue(id) != 0;
    if (!isGhost)
    {
      double center[3];
      cursor->GetPoint(center);
      this->Points->SetPoint(id, center);
      this->Ghosts->SetValue(id, 0);
    }
  }

  vtkIdType Leaves = 0;

private:
  bool IsUsedId(vtkIdType id) const { return id >= 0 && id < this->Points->GetNumberOfPoints(); }

  void CountLeaves(vtkHyperTree* tree, vtkIdType vertex)
  {
    if (tree->IsLeaf(vertex))
    {
      this->Leaves += this->IsUsedId(tree->GetGlobalIndexFromLocal(vertex)) ? 1 : 0;
      return;
    }
    for (int child = 0; child < tree->GetNumberOfChildren(); ++child)
    {
      this->CountLeaves(tree, tree->GetElderChildIndex(vertex) + child);
    }
  }

  const isopoint::Execution& Run;
  vtkPoints* const Points;
  vtkUnsignedCharArray* const Ghosts;
  vtkUnsignedCharArray* const InputGhosts;
};

} // namespace

vtkSmartPointer<vtkDataSet> vtkMakeDualGrid(vtkDataSet* input)
{
  if (auto* const image = vtkImageData::SafeDownCast(input))
  {
    return dualOf(image);
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(input))
  {
    return dualOf(grid);
  }
  return nullptr;
}

vtkSmartPointer<vtkPoints> vtkComputeCellCenters(
  const isopoint::Execution& execution, vtkDataSet* input)
{
  const vtkIdType count = input->GetNumberOfCells();
  auto centers = vtkSmartPointer<vtkPoints>::New();
  centers->SetDataType(vtkGetTypeOfPoints(input) == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  vtkAllocateTuples(centers->GetData(), count);
  if (count == 0)
  {
    return centers;
  }
  if (input->GetNumberOfPoints() == 0)
  {
    throw isopoint::UsageError("The input has cells, but no points: its cells have no centers. "
                               "Connect data with points.");
  }
  // GetCell() is thread-safe only after a first call on a single thread.
  vtkNew<vtkGenericCell> first;
  input->GetCell(0, first);
  const auto largestCell = static_cast<std::size_t>(std::max(8, input->GetMaxCellSize()));

  constexpr std::size_t grain = 4096;
  isopoint::forBatches(execution, static_cast<std::size_t>(count), 16 * grain, grain,
    [&](std::size_t begin, std::size_t end)
    {
      vtkNew<vtkGenericCell> cell;
      std::vector<double> weights(largestCell);
      for (auto id = static_cast<vtkIdType>(begin); id < static_cast<vtkIdType>(end); ++id)
      {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        double center[3] = { nan, nan, nan };
        input->GetCell(id, cell);
        if (cell->GetCellType() != VTK_EMPTY_CELL && cell->GetNumberOfPoints() > 0)
        {
          double parametric[3];
          int subId = cell->GetParametricCenter(parametric);
          cell->EvaluateLocation(subId, parametric, center, weights.data());
        }
        centers->SetPoint(id, center);
      }
    });
  return centers;
}

vtkIsopointLeafCenters vtkFindLeafCenters(
  const isopoint::Execution& execution, vtkHyperTreeGrid* input, vtkIdType count)
{
  vtkIsopointLeafCenters centers{ vtkSmartPointer<vtkPoints>::New(),
    vtkSmartPointer<vtkUnsignedCharArray>::New(), 0 };
  centers.Points->SetDataTypeToDouble();
  vtkAllocateTuples(centers.Points->GetData(), count);
  vtkAllocateTuples(centers.Ghosts, count);
  std::fill_n(static_cast<double*>(centers.Points->GetVoidPointer(0)), 3 * count,
    std::numeric_limits<double>::quiet_NaN());
  std::fill_n(centers.Ghosts->GetPointer(0), count,
    static_cast<unsigned char>(vtkDataSetAttributes::HIDDENPOINT));

  LeafCollector collector(
    execution, centers.Points, centers.Ghosts, vtkGetIsopointGhosts(input->GetCellData(), count));
  vtkHyperTreeGrid::vtkHyperTreeGridIterator trees;
  input->InitializeTreeIterator(trees);
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
  vtkIdType index = 0;
  while (trees.GetNextTree(index))
  {
    input->InitializeNonOrientedGeometryCursor(cursor, index);
    collector.Collect(cursor);
  }
  centers.NumberOfUnusedIds = count - collector.Leaves;
  return centers;
}
