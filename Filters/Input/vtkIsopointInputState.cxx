// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointInputState.h"

#include "Input/vtkIsopointCompatibility.h"

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

/// A hash, FNV-1a, that changing one number always changes.
class Hash
{
public:
  void Add(std::uint64_t number) { this->Value = (this->Value ^ number) * 1099511628211u; }
  vtkMTimeType Get() const { return static_cast<vtkMTimeType>(this->Value); }

private:
  std::uint64_t Value = 14695981039346656037u;
};

/// Adds a hash of the flags in an array. Blanking a point or a cell and masking a node change flags
/// in place without a new modification time.
template <class TArray>
void addFlags(vtkIsopointInputState& state, TArray* flags)
{
  add(state, static_cast<vtkObject*>(flags));
  Hash hash;
  const vtkIdType count = flags ? flags->GetNumberOfValues() : 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    hash.Add(static_cast<unsigned char>(flags->GetValue(i)));
  }
  state.push_back(hash.Get());
}

void addGhosts(vtkIsopointInputState& state, vtkDataSetAttributes* attributes)
{
  addFlags(state,
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

/// Subdividing or replacing a tree, or numbering its nodes, does not change the grid's modification
/// time.
void addTrees(vtkIsopointInputState& state, vtkHyperTreeGrid* trees)
{
  // A uniform grid has no coordinates, and is modified where its origin and scale are.
  if (!vtkUniformHyperTreeGrid::SafeDownCast(trees))
  {
    addCoordinates(
      state, trees->GetXCoordinates(), trees->GetYCoordinates(), trees->GetZCoordinates());
  }
  addFlags(state, trees->GetMask());
  vtkHyperTreeGrid::vtkHyperTreeGridIterator iterator;
  trees->InitializeTreeIterator(iterator);
  while (vtkHyperTree* const tree = iterator.GetNextTree())
  {
    add(state, tree);
    Hash hash;
    hash.Add(static_cast<std::uint64_t>(tree->GetTreeIndex()));
    for (vtkIdType vertex = 0; vertex < tree->GetNumberOfVertices(); ++vertex)
    {
      hash.Add(static_cast<std::uint64_t>(tree->GetGlobalIndexFromLocal(vertex)));
    }
    state.push_back(static_cast<vtkMTimeType>(tree->GetNumberOfVertices()));
    state.push_back(hash.Get());
  }
}

} // namespace

vtkIsopointInputState vtkGetIsopointGeometryState(vtkDataObject* leaf)
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
    // The cells are stored in a way of its own; only the grid knows their modification time.
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
    addTrees(state, trees);
  }
  addGhosts(state, leaf->GetAttributes(vtkDataObject::POINT));
  addGhosts(state, leaf->GetAttributes(vtkDataObject::CELL));
  return state;
}

void vtkAppendIsopointArrayState(vtkIsopointInputState& state, vtkDataArray* array)
{
  add(state, array);
}
