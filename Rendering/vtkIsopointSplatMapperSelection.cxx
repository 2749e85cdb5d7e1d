// SPDX-License-Identifier: GPL-3.0-or-later
// Hardware selection: ids of points are rendered, and mapped to the requested ids, of cells or of
// an id array, when the pixels are read.
#include "vtkIsopointSplatMapper.h"

#include "vtkIsopointSplatMapperInternals.h"

#include "vtkCellData.h"
#include "vtkHardwareSelector.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace
{

vtkIdType readId(vtkHardwareSelector* selector, int lowPass, int highPass, unsigned int offset)
{
  const unsigned char* const low = selector->GetRawPixelBuffer(lowPass);
  const unsigned char* const high = selector->GetRawPixelBuffer(highPass);
  vtkIdType id = high ? high[offset] : 0;
  for (int byte = 2; byte >= 0; --byte)
  {
    id = (id << 8) | low[offset + byte];
  }
  return id;
}

void writeBytes(unsigned char* pixels, unsigned int offset, vtkIdType value)
{
  for (int byte = 0; byte < 3; ++byte)
  {
    pixels[offset + byte] = static_cast<unsigned char>((value >> (8 * byte)) & 0xff);
  }
}

vtkIdType throughArray(vtkDataSetAttributes* attributes, const char* name, vtkIdType id)
{
  vtkDataArray* const array = name ? attributes->GetArray(name) : nullptr;
  return array && id < array->GetNumberOfTuples()
           ? static_cast<vtkIdType>(array->GetComponent(id, 0))
           : id;
}

} // namespace

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::UpdateMaximumPointCellIds(vtkRenderer* renderer, vtkActor*)
{
  vtkHardwareSelector* const selector = renderer->GetSelector();
  for (const auto& block : this->Internal->Blocks.Get())
  {
    const vtkIdType last = block->Data->GetNumberOfPoints() - 1;
    selector->UpdateMaximumPointId(last);
    // The passes for cells render ids of points, too.
    selector->UpdateMaximumCellId(std::max(last, block->Data->GetNumberOfCells() - 1));
    const auto include = [selector](vtkDataSetAttributes* attributes, const char* name,
                           void (vtkHardwareSelector::*update)(vtkIdType))
    {
      if (vtkDataArray* const ids = name ? attributes->GetArray(name) : nullptr)
      {
        (selector->*update)(static_cast<vtkIdType>(ids->GetRange(0)[1]));
      }
    };
    include(block->Data->GetPointData(), this->PointIdArrayName,
      &vtkHardwareSelector::UpdateMaximumPointId);
    include(
      block->Data->GetCellData(), this->CellIdArrayName, &vtkHardwareSelector::UpdateMaximumCellId);
  }
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp*)
{
  using Selector = vtkHardwareSelector;
  const int pass = selector->GetCurrentPass();
  const bool isCell = pass == Selector::CELL_ID_LOW24 || pass == Selector::CELL_ID_HIGH24;
  const bool isHigh = pass == Selector::CELL_ID_HIGH24 || pass == Selector::POINT_ID_HIGH24;
  const bool isPoint = pass == Selector::POINT_ID_LOW24 || pass == Selector::POINT_ID_HIGH24;
  const bool isProcess = pass == Selector::PROCESS_PASS && selector->GetUseProcessIdFromData();
  const int lowPass = isCell ? Selector::CELL_ID_LOW24 : Selector::POINT_ID_LOW24;
  const int highPass = isCell ? Selector::CELL_ID_HIGH24 : Selector::POINT_ID_HIGH24;
  unsigned char* const pixels = selector->GetPixelBuffer(pass);
  if (!this->PopulateSelectionSettings || !(isCell || isPoint || isProcess) || !pixels ||
      !selector->GetRawPixelBuffer(lowPass))
  {
    return;
  }
  const unsigned char* const composite =
    selector->GetRawPixelBuffer(Selector::COMPOSITE_INDEX_PASS);
  for (const unsigned int offset : pixelOffsets)
  {
    const unsigned int flatIndex =
      composite ? composite[offset] | (composite[offset + 1] << 8) | (composite[offset + 2] << 16)
                : 0;
    vtkIsopointSplatBlocks::Block* const block = this->Internal->Blocks.Find(flatIndex);
    if (!block)
    {
      continue;
    }
    const vtkIdType point = readId(selector, lowPass, highPass, offset);
    vtkIdType id = point;
    if (isCell)
    {
      const vtkIdType cell = vtkIsopointSplatBlocks::CellOfPoint(*block, point);
      id = cell < 0 ? 0 : throughArray(block->Data->GetCellData(), this->CellIdArrayName, cell);
    }
    else if (isPoint)
    {
      id = throughArray(block->Data->GetPointData(), this->PointIdArrayName, point);
    }
    else if (this->ProcessIdArrayName &&
             block->Data->GetPointData()->GetArray(this->ProcessIdArrayName))
    {
      id = 1 + throughArray(block->Data->GetPointData(), this->ProcessIdArrayName, point);
    }
    else
    {
      continue;
    }
    writeBytes(pixels, offset, isHigh ? id >> 24 : id);
  }
}
