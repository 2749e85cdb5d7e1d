// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedBlocks.h"

#include "vtkIsopointCompositeMapper.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <set>

namespace
{

/// Applies the attributes of a data object to itself or the blocks in it.
void applyAttributes(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
  std::vector<vtkIsopointTracedBlock>& blocks)
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
  for (vtkIsopointTracedBlock& block : blocks)
  {
    if (within.count(block.Data) == 0)
    {
      continue;
    }
    if (hasVisibility)
    {
      block.Visible = attributes->GetBlockVisibility(object);
    }
    if (hasColor)
    {
      block.HasColor = true;
      attributes->GetBlockColor(object, block.Color.data());
    }
  }
}

} // namespace

std::vector<vtkIsopointTracedBlock> vtkIsopointTracedBlocks(vtkMapper* mapper)
{
  vtkDataObject* const input = mapper->GetInputDataObject(0, 0);
  const auto compositeMapper = vtkIsopointCompositeMapper::SafeDownCast(mapper);
  vtkCompositeDataDisplayAttributes* const attributes =
    compositeMapper ? compositeMapper->GetCompositeDataDisplayAttributes() : nullptr;
  std::vector<vtkIsopointTracedBlock> blocks;
  const auto add = [&blocks](vtkDataObject* object)
  {
    vtkIsopointTracedBlock block;
    block.Data = vtkPolyData::SafeDownCast(object);
    if (block.Data && block.Data->GetNumberOfPoints() > 0)
    {
      blocks.push_back(block);
    }
  };
  vtkCompositeDataSet* const composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    add(input);
    return blocks;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    add(iterator->GetCurrentDataObject());
  }
  if (!attributes || !(attributes->HasBlockVisibilities() || attributes->HasBlockColors()))
  {
    return blocks;
  }
  // The iterator visits outer blocks before inner ones, whose attributes take precedence.
  applyAttributes(composite, attributes, blocks);
  if (const auto tree = vtkDataObjectTreeIterator::SafeDownCast(iterator))
  {
    tree->VisitOnlyLeavesOff();
  }
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    applyAttributes(iterator->GetCurrentDataObject(), attributes, blocks);
  }
  return blocks;
}
