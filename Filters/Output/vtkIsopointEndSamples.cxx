// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointEndSamples.h"

#include "Input/vtkIsopointAllocation.h"
#include "Isopoint/Base/Team.h"
#include "Output/vtkIsopointArrayBytes.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDataSetAttributesFieldList.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace
{

using isopoint::CoincidentSamples;
using isopoint::ExtractedIsosurface;
using isopoint::IsopointEdge;

/// The ids of all samples at ends of edges and of those that coincide with them, ascending.
std::vector<std::uint64_t> idsOf(const std::vector<ExtractedIsosurface>& surfaces)
{
  std::vector<std::uint64_t> ids;
  for (const ExtractedIsosurface& extracted : surfaces)
  {
    for (const IsopointEdge& edge : extracted.surface.edges)
    {
      ids.insert(ids.end(), { edge.first, edge.second });
    }
    for (const CoincidentSamples& group : extracted.surface.coincident)
    {
      ids.insert(ids.end(), group.ids.begin(), group.ids.end());
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Replaces each id by its position among the sorted ids.
void renumber(std::vector<ExtractedIsosurface>& surfaces, const std::vector<std::uint64_t>& ids)
{
  const auto renumberOne = [&ids](std::uint64_t& id)
  { id = static_cast<std::uint64_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); };
  for (ExtractedIsosurface& extracted : surfaces)
  {
    for (IsopointEdge& edge : extracted.surface.edges)
    {
      renumberOne(edge.first);
      renumberOne(edge.second);
    }
    for (CoincidentSamples& group : extracted.surface.coincident)
    {
      std::for_each(group.ids.begin(), group.ids.end(), renumberOne);
    }
  }
}

/// The range of sorted ids that belong to one block.
struct IdRange
{
  std::size_t block;
  std::size_t begin; // positions among the sorted ids
  std::size_t end;
  std::uint64_t firstId; // of the block's samples
};

std::vector<IdRange> idRangesOf(
  const std::vector<vtkIsopointBlock>& blocks, const std::vector<std::uint64_t>& ids)
{
  std::vector<IdRange> ranges;
  std::uint64_t firstId = 0;
  std::size_t begin = 0;
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    const auto endId = firstId + static_cast<std::uint64_t>(blocks[block].GetNumberOfSamples());
    const auto end =
      static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), endId) - ids.begin());
    ranges.push_back({ block, begin, end, firstId });
    firstId = endId;
    begin = end;
  }
  return ranges;
}

bool allHaveFloatScalars(const std::vector<vtkIsopointBlock>& blocks)
{
  return std::all_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointBlock& block) { return block.Scalars->GetDataType() == VTK_FLOAT; });
}

/// The attributes of a block that have one tuple for each sample.
vtkSmartPointer<vtkDataSetAttributes> completeAttributes(const vtkIsopointBlock& block)
{
  auto complete = vtkSmartPointer<vtkPointData>::New();
  complete->ShallowCopy(block.Attributes);
  for (int i = complete->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (complete->GetAbstractArray(i)->GetNumberOfTuples() != block.GetNumberOfSamples())
    {
      complete->RemoveArray(i);
    }
  }
  return complete;
}

/// Allocates arrays for the attributes that all blocks have, and copies the tuples with these ids.
void gatherAttributes(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<IdRange>& ranges, const std::vector<std::uint64_t>& ids,
  vtkDataSetAttributes* gathered)
{
  std::vector<vtkSmartPointer<vtkDataSetAttributes>> inputs;
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
  for (const IdRange& range : ranges)
  {
    common.TransformData(static_cast<int>(range.block), inputs[range.block], gathered,
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

/// The headers of the arrays that all blocks have, without the contoured ones and those that are
/// never interpolated; behind them that of the contoured array: float if it is in all blocks.
std::vector<vtkIsopointArrayHeader> headersOf(const std::vector<vtkIsopointBlock>& blocks)
{
  std::vector<std::vector<vtkIsopointArrayHeader>> lists;
  for (const vtkIsopointBlock& block : blocks)
  {
    std::vector<vtkIsopointArrayHeader> list =
      vtkListIsopointArrays(block.Attributes, block.GetNumberOfSamples());
    const char* const contoured = block.Scalars->GetName();
    list.erase(std::remove_if(list.begin(), list.end(),
                 [contoured](const vtkIsopointArrayHeader& header)
                 {
                   return header.Attribute == vtkDataSetAttributes::GLOBALIDS ||
                          header.Name == vtkDataSetAttributes::GhostArrayName() ||
                          (contoured && header.Name == contoured);
                 }),
      list.end());
    lists.push_back(std::move(list));
  }
  std::vector<vtkIsopointArrayHeader> common = vtkIntersectIsopointArrays(lists);
  if (!blocks.empty())
  {
    vtkIsopointArrayHeader contoured;
    const char* const name = blocks.front().Scalars->GetName();
    contoured.Name = name ? name : "";
    contoured.Type = allHaveFloatScalars(blocks) ? VTK_FLOAT : VTK_DOUBLE;
    common.push_back(contoured);
  }
  return common;
}

/// Those that the blocks of all ranks have in common. Collective.
std::vector<vtkIsopointArrayHeader> headersOf(
  isopoint::Team& team, const std::vector<vtkIsopointBlock>& blocks)
{
  std::vector<std::vector<char>> outgoing;
  team.together(
    [&]()
    {
      outgoing.assign(
        static_cast<std::size_t>(team.size()), vtkWriteIsopointArrayHeaders(headersOf(blocks)));
    });
  const std::vector<std::vector<char>> arrived = team.exchange(outgoing);
  std::vector<vtkIsopointArrayHeader> common;
  team.together(
    [&]()
    {
      std::vector<std::vector<vtkIsopointArrayHeader>> lists;
      vtkIsopointArrayHeader contoured;
      for (const std::vector<char>& bytes : arrived)
      {
        std::vector<vtkIsopointArrayHeader> list = vtkReadIsopointArrayHeaders(bytes);
        if (!list.empty())
        {
          const bool isFloat =
            list.back().Type == VTK_FLOAT && (lists.empty() || contoured.Type == VTK_FLOAT);
          contoured.Name = lists.empty() ? list.back().Name : contoured.Name;
          contoured.Type = isFloat ? VTK_FLOAT : VTK_DOUBLE;
          list.pop_back();
          lists.push_back(std::move(list));
        }
      }
      common = vtkIntersectIsopointArrays(lists);
      common.push_back(contoured);
    });
  return common;
}

/// The values of some samples of blocks, array by array.
std::vector<char> writeSamples(const std::vector<vtkIsopointBlock>& blocks,
  const std::vector<std::uint64_t>& ids, const std::vector<vtkIsopointArrayHeader>& headers)
{
  std::vector<char> bytes;
  const std::vector<IdRange> ranges = idRangesOf(blocks, ids);
  for (const vtkIsopointArrayHeader& header : headers)
  {
    for (const IdRange& range : ranges)
    {
      vtkAbstractArray* const array =
        blocks[range.block].Attributes->GetAbstractArray(header.Name.c_str());
      for (std::size_t i = range.begin; i < range.end; ++i)
      {
        vtkWriteIsopointTuple(array, static_cast<vtkIdType>(ids[i] - range.firstId), bytes);
      }
    }
  }
  return bytes;
}

} // namespace

vtkIsopointEndSamples::vtkIsopointEndSamples(isopoint::Team& team,
  const std::vector<vtkIsopointBlock>& blocks, std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  std::vector<std::uint64_t> ids;
  team.together([&]() { ids = idsOf(surfaces); });
  this->CopyFromRanks(team, blocks, ids);
  renumber(surfaces, ids);
}

void vtkIsopointEndSamples::CopyFromRanks(isopoint::Team& team,
  const std::vector<vtkIsopointBlock>& blocks, const std::vector<std::uint64_t>& ids)
{
  std::uint64_t ownCount = 0;
  for (const vtkIsopointBlock& block : blocks)
  {
    ownCount += static_cast<std::uint64_t>(block.GetNumberOfSamples());
  }
  const std::vector<std::uint64_t> counts = team.gather(ownCount);
  std::vector<std::vector<std::uint64_t>> questions;
  team.together(
    [&]()
    {
      questions.resize(counts.size());
      std::uint64_t first = 0;
      auto next = ids.begin();
      for (std::size_t rank = 0; rank < counts.size(); ++rank)
      {
        for (; next != ids.end() && *next < first + counts[rank]; ++next)
        {
          questions[rank].push_back(*next - first);
        }
        first += counts[rank];
      }
    });
  const std::vector<std::vector<std::uint64_t>> asked = team.exchange(questions);
  std::vector<vtkIsopointArrayHeader> headers = headersOf(team, blocks);
  const vtkIsopointArrayHeader contoured = headers.back();
  headers.pop_back();
  std::vector<std::vector<char>> answers;
  team.together(
    [&]()
    {
      for (const std::vector<std::uint64_t>& wanted : asked)
      {
        answers.push_back(writeSamples(blocks, wanted, headers));
      }
    });
  const std::vector<std::vector<char>> arrived = team.exchange(answers);
  team.together(
    [&]()
    {
      this->Copied = vtkSmartPointer<vtkPointData>::New();
      const auto count = static_cast<vtkIdType>(ids.size());
      std::vector<const char*> next;
      next.reserve(arrived.size());
      for (const std::vector<char>& bytes : arrived)
      {
        next.push_back(bytes.data());
      }
      for (const vtkIsopointArrayHeader& header : headers)
      {
        const vtkSmartPointer<vtkAbstractArray> array = vtkNewIsopointArray(header, count);
        vtkIdType tuple = 0;
        for (std::size_t rank = 0; rank < next.size(); ++rank)
        {
          for (std::size_t i = 0; i < questions[rank].size(); ++i)
          {
            next[rank] = vtkReadIsopointTuple(next[rank], array, tuple++);
          }
        }
        const int index = this->Copied->AddArray(array);
        if (header.Attribute >= 0)
        {
          this->Copied->SetActiveAttribute(index, header.Attribute);
        }
      }
      // Of the contoured array nothing but name and type is asked for.
      const vtkSmartPointer<vtkAbstractArray> scalars = vtkNewIsopointArray(contoured, count);
      scalars->SetName(contoured.Name.empty() ? nullptr : contoured.Name.c_str());
      this->Scalars = vtkDataArray::SafeDownCast(scalars);
      this->Copied->AddArray(scalars);
      this->Attributes = this->Copied;
    });
}

vtkIsopointEndSamples::~vtkIsopointEndSamples() = default;

vtkIsopointEndSamples::vtkIsopointEndSamples(
  const std::vector<vtkIsopointBlock>& blocks, std::vector<isopoint::ExtractedIsosurface>& surfaces)
  : Attributes(blocks.front().Attributes)
  , Scalars(blocks.front().Scalars)
{
  if (blocks.size() == 1)
  {
    return;
  }
  const std::vector<std::uint64_t> ids = idsOf(surfaces);
  const std::vector<IdRange> ranges = idRangesOf(blocks, ids);
  const auto scalars = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(allHaveFloatScalars(blocks) ? VTK_FLOAT : VTK_DOUBLE));
  scalars->SetName(this->Scalars->GetName());
  vtkAllocateTuples(scalars, static_cast<vtkIdType>(ids.size()));
  for (const IdRange& range : ranges)
  {
    vtkDataArray* const ofBlock = blocks[range.block].Scalars;
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      const auto from = static_cast<vtkIdType>(ids[i] - range.firstId);
      scalars->SetComponent(static_cast<vtkIdType>(i), 0, ofBlock->GetComponent(from, 0));
    }
  }
  renumber(surfaces, ids);

  this->Copied = vtkSmartPointer<vtkPointData>::New();
  gatherAttributes(blocks, ranges, ids, this->Copied);
  if (scalars->GetName())
  {
    this->Copied->RemoveArray(scalars->GetName());
  }
  this->Copied->AddArray(scalars);
  this->Attributes = this->Copied;
  this->Scalars = scalars;
}
