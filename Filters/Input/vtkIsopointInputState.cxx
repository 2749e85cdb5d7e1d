// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointInputState.h"

#include "Common/vtkIsopointCompatibility.h"
#include "Core/Base/Hash.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkHyperTree.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkUniformHyperTreeGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridBase.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace
{

void add(vtkIsopointInputState& state, vtkObject* object)
{
  state.push_back(object ? object->GetMTime() : 0);
}

void add(vtkIsopointInputState& state, vtkCellArray* cells)
{
  state.push_back(cells ? cells->GetMTime() : 0);
  add(state, cells ? cells->GetConnectivityArray() : nullptr);
  add(state, cells ? cells->GetOffsetsArray() : nullptr);
}

/// Adds a hash of the flags in an array of bits or bytes. Blanking points or cells and masking
/// nodes change flags in place without a new modification time.
template <class TArray>
void addFlags(const isopoint::Execution& execution, vtkIsopointInputState& state, TArray* flags)
{
  add(state, static_cast<vtkObject*>(flags));
  const vtkIdType count = flags ? flags->GetNumberOfValues() : 0;
  state.push_back(static_cast<vtkMTimeType>(count));
  if (count > 0)
  {
    const vtkIdType perByte = flags->GetDataType() == VTK_BIT ? 8 : 1;
    state.push_back(isopoint::hashOf(
      execution, flags->GetPointer(0), static_cast<std::size_t>((count + perByte - 1) / perByte)));
  }
}

void addGhosts(const isopoint::Execution& execution, vtkIsopointInputState& state,
  vtkDataSetAttributes* attributes)
{
  addFlags(execution, state,
    vtkUnsignedCharArray::SafeDownCast(
      attributes ? attributes->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) : nullptr));
}

void addGrid(vtkIsopointInputState& state, vtkUnstructuredGrid* grid)
{
  add(state, grid->GetCells());
  add(state, vtkGetTypesOfCells(grid));
  const auto faces = vtkGetFacesOfPolyhedra(grid);
  add(state, faces.first);
  add(state, faces.second);
}

void addCoordinates(vtkIsopointInputState& state, vtkDataArray* x, vtkDataArray* y, vtkDataArray* z)
{
  add(state, x);
  add(state, y);
  add(state, z);
}

/// Adds the trees, because changing a tree does not change the grid's modification time.
void addTrees(
  const isopoint::Execution& execution, vtkIsopointInputState& state, vtkHyperTreeGrid* trees)
{
  // A uniform grid has no coordinates; changes of its origin and scale modify the grid.
  if (!vtkUniformHyperTreeGrid::SafeDownCast(trees))
  {
    addCoordinates(
      state, trees->GetXCoordinates(), trees->GetYCoordinates(), trees->GetZCoordinates());
  }
  addFlags(execution, state, trees->GetMask());
  std::vector<vtkHyperTree*> all;
  vtkHyperTreeGrid::vtkHyperTreeGridIterator iterator;
  trees->InitializeTreeIterator(iterator);
  while (vtkHyperTree* const tree = iterator.GetNextTree())
  {
    add(state, tree);
    state.push_back(static_cast<vtkMTimeType>(tree->GetNumberOfVertices()));
    all.push_back(tree);
  }
  const std::size_t first = state.size();
  state.resize(first + all.size());
  isopoint::forBatches(execution, all.size(), 64, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const auto count = static_cast<std::size_t>(all[i]->GetNumberOfVertices());
        std::vector<std::uint64_t> numbers(count + 1);
        numbers[count] = static_cast<std::uint64_t>(all[i]->GetTreeIndex());
        for (std::size_t vertex = 0; vertex < count; ++vertex)
        {
          numbers[vertex] = static_cast<std::uint64_t>(
            all[i]->GetGlobalIndexFromLocal(static_cast<vtkIdType>(vertex)));
        }
        state[first + i] = isopoint::hashOf(numbers.data(), numbers.size());
      }
    });
}

} // namespace

vtkIsopointInputState vtkGetIsopointGeometryState(
  const isopoint::Execution& execution, vtkDataObject* leaf)
{
  vtkIsopointInputState state{ leaf->vtkObject::GetMTime() };
  if (auto* const pointSet = vtkPointSet::SafeDownCast(leaf))
  {
    add(state, pointSet->GetPoints());
    add(state, pointSet->GetPoints() ? pointSet->GetPoints()->GetData() : nullptr);
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(leaf))
  {
    addGrid(state, grid);
  }
  else if (vtkUnstructuredGridBase::SafeDownCast(leaf))
  {
    // Only the grid knows the modification time of its cells.
    add(state, static_cast<vtkObject*>(leaf));
  }
  if (auto* const grid = vtkExplicitStructuredGrid::SafeDownCast(leaf))
  {
    add(state, grid->GetCells());
  }
  if (auto* const polyData = vtkPolyData::SafeDownCast(leaf))
  {
    add(state, polyData->GetVerts());
    add(state, polyData->GetLines());
    add(state, polyData->GetPolys());
    add(state, polyData->GetStrips());
  }
  if (auto* const image = vtkImageData::SafeDownCast(leaf))
  {
    add(state, image->GetDirectionMatrix());
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(leaf))
  {
    addCoordinates(
      state, grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates());
  }
  if (auto* const trees = vtkHyperTreeGrid::SafeDownCast(leaf))
  {
    addTrees(execution, state, trees);
  }
  addGhosts(execution, state, leaf->GetAttributes(vtkDataObject::POINT));
  addGhosts(execution, state, leaf->GetAttributes(vtkDataObject::CELL));
  return state;
}
