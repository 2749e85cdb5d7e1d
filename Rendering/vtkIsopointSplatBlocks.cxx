// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatBlocks.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <set>
#include <utility>

namespace
{

/// Applies the attributes of a data object to the leaves that it is or contains.
void applyAttributes(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
  std::vector<vtkIsopointSplatLeaf>& leaves)
{
  const bool hasVisibility = attributes->HasBlockVisibility(object);
  const bool hasColor = attributes->HasBlockColor(object);
  if (!hasVisibility && !hasColor)
  {
    return;
  }
  std::set<vtkDataObject*> within = { object };
  if (vtkCompositeDataSet* const composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      within.insert(iterator->GetCurrentDataObject());
    }
  }
  for (vtkIsopointSplatLeaf& leaf : leaves)
  {
    if (within.count(leaf.Data) == 0)
    {
      continue;
    }
    if (hasVisibility)
    {
      leaf.Visible = attributes->GetBlockVisibility(object);
    }
    if (hasColor)
    {
      leaf.HasColor = true;
      attributes->GetBlockColor(object, leaf.Color.data());
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkIsopointSplatLeaf> vtkIsopointSplatLeaves(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes)
{
  std::vector<vtkIsopointSplatLeaf> leaves;
  const auto add = [&leaves](unsigned int index, vtkDataObject* object)
  {
    vtkIsopointSplatLeaf leaf;
    leaf.Data = vtkPolyData::SafeDownCast(object);
    leaf.FlatIndex = index;
    if (leaf.Data && leaf.Data->GetNumberOfPoints() > 0)
    {
      leaves.push_back(leaf);
    }
  };
  vtkCompositeDataSet* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    add(0, input);
    return leaves;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    add(iterator->GetCurrentFlatIndex(), iterator->GetCurrentDataObject());
  }
  if (!attributes || !(attributes->HasBlockVisibilities() || attributes->HasBlockColors()))
  {
    return leaves;
  }
  // The iterator visits outer blocks before inner ones, whose attributes replace theirs.
  applyAttributes(composite, attributes, leaves);
  if (const auto tree = vtkDataObjectTreeIterator::SafeDownCast(iterator))
  {
    tree->VisitOnlyLeavesOff();
  }
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    applyAttributes(iterator->GetCurrentDataObject(), attributes, leaves);
  }
  return leaves;
}

//------------------------------------------------------------------------------
void vtkIsopointSplatBlocks::SetInput(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes)
{
  this->Composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
  std::vector<std::unique_ptr<Block>> former = std::move(this->Blocks);
  this->Blocks.clear();
  for (const vtkIsopointSplatLeaf& leaf : vtkIsopointSplatLeaves(input, attributes))
  {
    const auto same = std::find_if(former.begin(), former.end(),
      [&leaf](const std::unique_ptr<Block>& block) { return block && block->Data == leaf.Data; });
    this->Blocks.push_back(same == former.end() ? std::make_unique<Block>() : std::move(*same));
    this->Blocks.back()->Data = leaf.Data;
    this->Blocks.back()->Leaf = leaf;
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
    { return block->Leaf.FlatIndex < index; });
  return found != this->Blocks.end() && (*found)->Leaf.FlatIndex == flatIndex ? found->get()
                                                                              : nullptr;
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
