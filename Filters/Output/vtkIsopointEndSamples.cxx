// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointEndSamples.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Lists.h"
#include "Core/Base/ProcessGroup.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointArrayBytes.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDataSetAttributesFieldList.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace
{

/// Calls visit(id) for the samples at the ends of edges, and for samples coincident with them.
template <class Surfaces, class Visitor>
void forEachEndSample(Surfaces& surfaces, const Visitor& visit)
{
  for (auto& extracted : surfaces)
  {
    for (auto& edge : extracted.surface.edges)
    {
      visit(edge.first);
      visit(edge.second);
    }
    for (auto& group : extracted.surface.coincident)
    {
      std::for_each(group.ids.begin(), group.ids.end(), visit);
    }
  }
}

/// The ids of these samples, sorted.
std::vector<std::uint64_t> listEndSamples(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  std::vector<std::uint64_t> ids;
  forEachEndSample(surfaces, [&ids](std::uint64_t id) { ids.push_back(id); });
  isopoint::keepUnique(ids);
  return ids;
}

/// Replaces each id by its index in the list.
void renumberEndSamples(
  std::vector<isopoint::ExtractedIsosurface>& surfaces, const std::vector<std::uint64_t>& ids)
{
  forEachEndSample(surfaces,
    [&ids](std::uint64_t& id) {
      id = static_cast<std::uint64_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    });
}

/// The numbers of samples.
std::vector<std::uint64_t> countsOf(const std::vector<vtkIsopointBlock>& blocks)
{
  std::vector<std::uint64_t> counts;
  counts.reserve(blocks.size());
  for (const vtkIsopointBlock& block : blocks)
  {
    counts.push_back(static_cast<std::uint64_t>(block.Scalars->GetNumberOfTuples()));
  }
  return counts;
}

/// The sorted ids that belong to one block or rank.
struct IdRange
{
  std::size_t begin; // index of a sorted id
  std::size_t end;
  std::uint64_t firstId; // of the samples of the block or rank
};

/// @param counts numbers of samples by block or rank
std::vector<IdRange> idRangesOf(
  const std::vector<std::uint64_t>& counts, const std::vector<std::uint64_t>& ids)
{
  std::vector<IdRange> ranges;
  std::uint64_t firstId = 0;
  std::size_t begin = 0;
  for (const std::uint64_t count : counts)
  {
    const auto end = static_cast<std::size_t>(
      std::lower_bound(ids.begin(), ids.end(), firstId + count) - ids.begin());
    ranges.push_back({ begin, end, firstId });
    firstId += count;
    begin = end;
  }
  return ranges;
}

/// The attributes of a block with one tuple per sample.
vtkSmartPointer<vtkPointData> completeAttributes(const vtkIsopointBlock& block)
{
  auto complete = vtkSmartPointer<vtkPointData>::New();
  complete->ShallowCopy(block.Attributes);
  for (int i = complete->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (complete->GetAbstractArray(i)->GetNumberOfTuples() != block.Scalars->GetNumberOfTuples())
    {
      complete->RemoveArray(i);
    }
  }
  return complete;
}

/// Copies the tuples with these ids of the attributes that all blocks have.
void gatherAttributes(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<IdRange>& ranges, const std::vector<std::uint64_t>& ids,
  vtkDataSetAttributes* gathered)
{
  std::vector<vtkSmartPointer<vtkPointData>> inputs;
  vtkDataSetAttributesFieldList common;
  for (const vtkIsopointBlock& block : blocks)
  {
    inputs.push_back(completeAttributes(block));
    common.IntersectFieldList(inputs.back());
  }
  gathered->CopyAllOn();
  const auto count = static_cast<vtkIdType>(ids.size());
  common.CopyAllocate(gathered, vtkDataSetAttributes::PASSDATA, 1, 0);
  for (int i = 0; i < gathered->GetNumberOfArrays(); ++i)
  {
    vtkAllocateTuples(gathered->GetAbstractArray(i), count);
  }
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    const IdRange& range = ranges[block];
    common.TransformData(static_cast<int>(block), inputs[block], gathered,
      [&](vtkAbstractArray* input, vtkAbstractArray* output)
      {
        for (std::size_t i = range.begin; i < range.end; ++i)
        {
          output->SetTuple(
            static_cast<vtkIdType>(i), static_cast<vtkIdType>(ids[i] - range.firstId), input);
        }
      });
  }
}

/// Copies the contoured array at these ids; float if it is float in all blocks.
vtkSmartPointer<vtkDataArray> gatherScalars(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<IdRange>& ranges, const std::vector<std::uint64_t>& ids)
{
  const bool areFloat = std::all_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointBlock& block) { return block.Scalars->GetDataType() == VTK_FLOAT; });
  auto scalars = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(areFloat ? VTK_FLOAT : VTK_DOUBLE));
  scalars->SetName(blocks.front().Scalars->GetName());
  scalars->SetNumberOfComponents(blocks.front().Scalars->GetNumberOfComponents());
  vtkAllocateTuples(scalars, static_cast<vtkIdType>(ids.size()));
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    const IdRange& range = ranges[block];
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      const auto from = static_cast<vtkIdType>(ids[i] - range.firstId);
      for (int component = 0; component < scalars->GetNumberOfComponents(); ++component)
      {
        scalars->SetComponent(static_cast<vtkIdType>(i), component,
          blocks[block].Scalars->GetComponent(from, component));
      }
    }
  }
  return scalars;
}

/// Copies the positions at these ids.
vtkSmartPointer<vtkDataArray> gatherPositions(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<IdRange>& ranges, const std::vector<std::uint64_t>& ids)
{
  auto positions = vtkSmartPointer<vtkDoubleArray>::New();
  positions->SetNumberOfComponents(3);
  vtkAllocateTuples(positions, static_cast<vtkIdType>(ids.size()));
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    const vtkIsopointPositions read(blocks[block].Positions);
    for (std::size_t i = ranges[block].begin; i < ranges[block].end; ++i)
    {
      read(ids[i] - ranges[block].firstId, positions->GetPointer(3 * static_cast<vtkIdType>(i)));
    }
  }
  return positions;
}

/// Copies the common attributes at these ids, with values or positions at the end.
vtkSmartPointer<vtkPointData> copiedSamples(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<std::uint64_t>& ids, vtkIsopointEndSamples::Numbers numbers)
{
  auto copied = vtkSmartPointer<vtkPointData>::New();
  const std::vector<IdRange> ranges = idRangesOf(countsOf(blocks), ids);
  gatherAttributes(blocks, ranges, ids, copied);
  const vtkSmartPointer<vtkDataArray> scalars = numbers == vtkIsopointEndSamples::Positions
                                                  ? gatherPositions(blocks, ranges, ids)
                                                  : gatherScalars(blocks, ranges, ids);
  if (scalars->GetName())
  {
    copied->RemoveArray(scalars->GetName());
  }
  copied->AddArray(scalars);
  return copied;
}

/// The same, with attributes in the order of the first block.
vtkSmartPointer<vtkPointData> copiedInOrder(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<std::uint64_t>& ids, vtkIsopointEndSamples::Numbers numbers)
{
  const vtkSmartPointer<vtkPointData> copied = copiedSamples(blocks, ids, numbers);
  const int contoured = copied->GetNumberOfArrays() - 1;
  auto ordered = vtkSmartPointer<vtkPointData>::New();
  vtkDataSetAttributes* const first = blocks.front().Attributes;
  for (int i = 0; i < first->GetNumberOfArrays(); ++i)
  {
    int index = -1;
    const char* const name = first->GetAbstractArray(i)->GetName();
    vtkAbstractArray* const array = name ? copied->GetAbstractArray(name, index) : nullptr;
    if (array && index != contoured)
    {
      vtkAddAttribute(copied->IsArrayAnAttribute(index), array, ordered);
    }
  }
  ordered->AddArray(copied->GetAbstractArray(contoured));
  return ordered;
}

} // namespace

vtkIsopointEndSamples::vtkIsopointEndSamples(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, std::vector<isopoint::ExtractedIsosurface>& surfaces,
  Numbers numbers)
{
  if (processes.size() > 1)
  {
    this->CopyFromRanks(processes, blocks, surfaces, numbers);
  }
  else if (blocks.size() > 1)
  {
    const std::vector<std::uint64_t> ids = listEndSamples(surfaces);
    this->Use(copiedSamples(blocks, ids, numbers));
    renumberEndSamples(surfaces, ids);
  }
  else
  {
    this->Attributes = blocks.front().Attributes;
    this->Scalars = blocks.front().Scalars;
    this->Block = blocks.front().Positions;
  }
}

vtkIsopointEndSamples::~vtkIsopointEndSamples() = default;

void vtkIsopointEndSamples::GetPosition(std::size_t sample, double position[3]) const
{
  this->Block ? vtkIsopointPositions(this->Block)(sample, position)
              : this->Scalars->GetTuple(static_cast<vtkIdType>(sample), position);
}

void vtkIsopointEndSamples::CopyFromRanks(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, std::vector<isopoint::ExtractedIsosurface>& surfaces,
  Numbers numbers)
{
  const std::vector<std::uint64_t> ids = listEndSamples(surfaces);
  const std::vector<std::uint64_t> counts = countsOf(blocks);
  const std::uint64_t ownCount = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
  std::vector<std::vector<std::uint64_t>> wanted; // by rank; ids count from its first sample
  for (const IdRange& range : idRangesOf(processes.gather(ownCount), ids))
  {
    wanted.emplace_back();
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      wanted.back().push_back(ids[i] - range.firstId);
    }
  }
  std::vector<isopoint::ByteBuffer> answers;
  for (const std::vector<std::uint64_t>& asked : processes.exchange(wanted))
  {
    answers.push_back(blocks.empty()
                        ? isopoint::ByteBuffer()
                        : vtkWriteIsopointArrays(copiedInOrder(blocks, asked, numbers)));
  }
  this->Join(processes.exchange(answers), ids.size());
  renumberEndSamples(surfaces, ids);
}

void vtkIsopointEndSamples::Join(
  const std::vector<isopoint::ByteBuffer>& arrived, std::size_t count)
{
  std::vector<vtkSmartPointer<vtkPointData>> attributes;
  std::vector<vtkSmartPointer<vtkDataArray>> scalars;
  std::vector<vtkIsopointBlock> pieces;
  for (const isopoint::ByteBuffer& bytes : arrived)
  {
    if (!bytes.empty())
    {
      attributes.push_back(vtkReadIsopointArrays(bytes));
      const int contoured = attributes.back()->GetNumberOfArrays() - 1;
      scalars.emplace_back(attributes.back()->GetArray(contoured));
      attributes.back()->RemoveArray(contoured);
      pieces.emplace_back();
      pieces.back().Attributes = attributes.back();
      pieces.back().Scalars = scalars.back();
    }
  }
  std::vector<std::uint64_t> all(count);
  std::iota(all.begin(), all.end(), std::uint64_t{ 0 });
  this->Use(copiedInOrder(pieces, all, Values));
}

void vtkIsopointEndSamples::Use(vtkPointData* copied)
{
  this->Copied = copied;
  this->Attributes = copied;
  this->Scalars = copied->GetArray(copied->GetNumberOfArrays() - 1);
}
