// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointInput.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Contour.h"
#include "Input/vtkIsopointBlocks.h"
#include "Input/vtkIsopointNumbers.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace
{

const unsigned char* ghostsOf(const vtkIsopointBlock& block)
{
  return block.Ghosts ? block.Ghosts->GetPointer(0) : nullptr;
}

/// Reads the samples of several blocks for IsosurfaceExtractor::load().
class BlockReader
{
public:
  explicit BlockReader(const std::vector<vtkIsopointBlock>& blocks)
    : Ids(blocks)
  {
    for (const vtkIsopointBlock& block : blocks)
    {
      this->Parts.push_back({ vtkIsopointPositions(block.Positions),
        vtkIsopointNumbers(block.Scalars), ghostsOf(block) });
    }
  }

  std::size_t count() const { return this->Ids.GetCount(); }

  template <class TCoordinate, class TValue>
  bool operator()(std::size_t id, TCoordinate* position, TValue& value) const
  {
    const auto [block, point] = this->Ids.Find(id);
    const Part& part = this->Parts[block];
    if (part.Ghosts && (part.Ghosts[point] & vtkIsopointBlock::Excluding) != 0)
    {
      return false;
    }
    double coordinates[3];
    part.Positions(point, coordinates);
    std::transform(coordinates, coordinates + 3, position,
      [](double coordinate) { return static_cast<TCoordinate>(coordinate); });
    value = static_cast<TValue>(part.Values(point));
    return true;
  }

private:
  struct Part
  {
    vtkIsopointPositions Positions;
    vtkIsopointNumbers Values;
    const unsigned char* Ghosts;
  };

  vtkIsopointSampleIds Ids;
  std::vector<Part> Parts;
};

} // namespace

isopoint::SampleTypes vtkGetIsopointSampleTypes(const std::vector<vtkIsopointBlock>& blocks)
{
  isopoint::SampleTypes types{ true, true, true };
  for (const vtkIsopointBlock& block : blocks)
  {
    const int type = block.Scalars ? block.Scalars->GetDataType() : VTK_FLOAT;
    types.areFloatPositions &= vtkGetTypeOfPoints(block.Positions) == VTK_FLOAT;
    types.areFloatValues &= type == VTK_FLOAT || vtkDataArray::GetDataTypeSize(type) <= 2;
    types.areIntegers &= block.Scalars && !vtkIsReal(block.Scalars);
  }
  return types;
}

isopoint::CloudCounts vtkCountIsopointSamples(const std::vector<vtkIsopointBlock>& blocks)
{
  isopoint::CloudCounts counts;
  for (const vtkIsopointBlock& block : blocks)
  {
    const auto unused = static_cast<std::uint64_t>(block.NumberOfUnusedIds);
    counts.items += static_cast<std::uint64_t>(block.GetNumberOfSamples());
    counts.excluded += static_cast<std::uint64_t>(block.NumberOfExcluded) - unused;
    counts.unused += unused;
  }
  return counts;
}

void vtkLoadIsopointInput(const isopoint::Execution& execution, isopoint::ProcessGroup& processes,
  const isopoint::SampleTypes& types, const std::vector<vtkIsopointBlock>& blocks,
  isopoint::IsosurfaceExtractor& extractor)
{
  const BlockReader read(blocks);
  isopoint::loadOrReplace(execution, &processes, extractor, types, read.count(), read);
}
