// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatBlocks.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

//------------------------------------------------------------------------------
std::vector<std::pair<unsigned int, vtkPolyData*>> vtkIsopointSplatLeaves(vtkDataObject* input)
{
  std::vector<std::pair<unsigned int, vtkPolyData*>> leaves;
  const auto add = [&leaves](unsigned int index, vtkDataObject* object)
  {
    vtkPolyData* const polyData = vtkPolyData::SafeDownCast(object);
    if (polyData && polyData->GetNumberOfPoints() > 0)
    {
      leaves.emplace_back(index, polyData);
    }
  };
  if (vtkCompositeDataSet* const composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentFlatIndex(), iterator->GetCurrentDataObject());
    }
  }
  else
  {
    add(0, input);
  }
  return leaves;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBlocks::SetInput(vtkDataObject* input)
{
  this->Composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
  std::vector<std::unique_ptr<Block>> former = std::move(this->Blocks);
  this->Blocks.clear();
  for (const auto& leaf : vtkIsopointSplatLeaves(input))
  {
    const auto same = std::find_if(former.begin(), former.end(),
      [&leaf](const std::unique_ptr<Block>& block) { return block && block->Data == leaf.second; });
    this->Blocks.push_back(same == former.end() ? std::make_unique<Block>() : std::move(*same));
    this->Blocks.back()->Data = leaf.second;
    this->Blocks.back()->FlatIndex = leaf.first;
  }
}

//------------------------------------------------------------------------------
vtkIsopointSplatBlocks::Block* vtkIsopointSplatBlocks::Find(unsigned int flatIndex) const
{
  if (!this->Composite)
  {
    return this->Blocks.empty() ? nullptr : this->Blocks.front().get();
  }
  const auto found = std::lower_bound(this->Blocks.begin(), this->Blocks.end(), flatIndex,
    [](const std::unique_ptr<Block>& block, unsigned int index)
    { return block->FlatIndex < index; });
  return found != this->Blocks.end() && (*found)->FlatIndex == flatIndex ? found->get() : nullptr;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsopointSplatBlocks::CellOfPoint(Block& block, vtkIdType point)
{
  if (block.CellOfPoint.empty())
  {
    block.CellOfPoint.assign(static_cast<std::size_t>(block.Data->GetNumberOfPoints()), -1);
    vtkCellArray* const vertices = block.Data->GetVerts();
    for (vtkIdType cell = vertices->GetNumberOfCells() - 1; cell >= 0; --cell)
    {
      vtkIdType count = 0;
      const vtkIdType* points = nullptr;
      vertices->GetCellAtId(cell, count, points);
      for (vtkIdType i = 0; i < count; ++i)
      {
        block.CellOfPoint[points[i]] = cell;
      }
    }
  }
  return point < static_cast<vtkIdType>(block.CellOfPoint.size()) ? block.CellOfPoint[point] : -1;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBlocks::ReleaseGraphicsResources()
{
  for (const std::unique_ptr<Block>& block : this->Blocks)
  {
    block->Buffers.ReleaseGraphicsResources();
    block->GeometryState.clear();
    block->ColorState.clear();
  }
}
