// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointSampleArrays.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/Lists.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Contour.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointArrayBytes.h"
#include "Output/vtkIsopointOutputArrays.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace
{

using Arrays = std::vector<vtkIsopointSampleArray>;

/// The arrays of a block; those without values for all samples have no components.
Arrays arraysOf(const vtkIsopointBlock& block, const std::vector<std::string>& nearest)
{
  Arrays arrays;
  vtkDataSetAttributes* const attributes = block.Attributes;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = attributes->GetAbstractArray(i);
    const int attribute = attributes->IsArrayAnAttribute(i);
    if (!array->GetName() || vtkIsGhostArrayName(array->GetName()))
    {
      continue;
    }
    const bool isText = array->GetDataType() == VTK_STRING;
    const bool isUsed = (vtkDataArray::SafeDownCast(array) || isText) &&
                        array->GetNumberOfTuples() == block.GetNumberOfSamples();
    const bool isListed =
      std::find(nearest.begin(), nearest.end(), array->GetName()) != nearest.end();
    // Several places may have the id of one sample, so these are no global ids.
    const bool areGlobal = attribute == vtkDataSetAttributes::GLOBALIDS;
    arrays.push_back({ array->GetName(), isUsed ? array->GetNumberOfComponents() : 0,
      array->GetDataType(), areGlobal ? -1 : attribute, !vtkIsReal(array),
      isText || isListed || vtkHasIsopointIds(array, attribute), {} });
  }
  return arrays;
}

/// What two lists have in common; other arrays have no components.
Arrays common(Arrays all, const Arrays& others)
{
  const auto find = [](Arrays& arrays, const vtkIsopointSampleArray& wanted)
  {
    return std::find_if(arrays.begin(), arrays.end(),
      [&](const vtkIsopointSampleArray& array) { return array.Name == wanted.Name; });
  };
  Arrays rest = others;
  for (vtkIsopointSampleArray& array : all)
  {
    const auto other = find(rest, array);
    const bool isText = array.Type == VTK_STRING;
    if (other == rest.end() || other->Components != array.Components ||
        (other->Type == VTK_STRING) != isText)
    {
      array.Components = 0;
    }
    else
    {
      array.Type = other->Type == array.Type ? array.Type : VTK_DOUBLE;
      array.Attribute = other->Attribute == array.Attribute ? array.Attribute : -1;
      array.AreIntegers = array.AreIntegers && other->AreIntegers;
      array.IsNearest = array.IsNearest || other->IsNearest;
    }
  }
  for (vtkIsopointSampleArray& array : rest)
  {
    if (find(all, array) == all.end())
    {
      all.push_back(array);
      all.back().Components = 0;
    }
  }
  return all;
}

Arrays commonOfRanks(isopoint::ProcessGroup& processes, const Arrays& own, bool hasBlocks)
{
  isopoint::ByteBuffer bytes;
  for (const vtkIsopointSampleArray& array : own)
  {
    isopoint::appendText(bytes, array.Name);
    for (const int number : { array.Components, array.Type, array.Attribute })
    {
      isopoint::append(bytes, number);
    }
    isopoint::append(bytes, array.AreIntegers);
    isopoint::append(bytes, array.IsNearest);
  }
  const std::vector<std::uint64_t> haveBlocks = processes.gather(std::uint64_t{ hasBlocks });
  const std::vector<isopoint::ByteBuffer> all = processes.gather(bytes);
  Arrays merged;
  bool isFirst = true;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    Arrays arrays;
    isopoint::ByteReader reader(all[rank]);
    while (!reader.isAtEnd())
    {
      vtkIsopointSampleArray& array = arrays.emplace_back();
      array.Name = reader.readText();
      array.Components = reader.read<int>();
      array.Type = reader.read<int>();
      array.Attribute = reader.read<int>();
      array.AreIntegers = reader.read<bool>();
      array.IsNearest = reader.read<bool>();
    }
    if (haveBlocks[rank] != 0)
    {
      merged = isFirst ? arrays : common(merged, arrays);
      isFirst = false;
    }
  }
  return merged;
}

/// What the blocks of all ranks have in common; other arrays have no components.
/// @param list(block) the arrays of a block
template <class List>
Arrays commonOfBlocks(
  isopoint::ProcessGroup& processes, const std::vector<vtkIsopointBlock>& blocks, const List& list)
{
  Arrays all;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    all = i == 0 ? list(blocks[i]) : common(all, list(blocks[i]));
  }
  return processes.size() > 1 ? commonOfRanks(processes, all, !blocks.empty()) : all;
}

} // namespace

vtkIsopointSampleArray vtkFindIsopointArray(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, const vtkIsopointArrayChoice& choice)
{
  // Without names: those of a chosen attribute may differ.
  vtkIsopointSampleArray found = commonOfBlocks(processes, blocks,
    [&](const vtkIsopointBlock& block)
    {
      vtkAbstractArray* const array = choice.Find(block.Attributes);
      return Arrays{ { "", array->GetNumberOfComponents(), array->GetDataType(), -1,
        !vtkIsReal(array), false, {} } };
    }).front();
  for (const vtkIsopointBlock& block : blocks)
  {
    found.Parts.push_back(vtkDataArray::SafeDownCast(choice.Find(block.Attributes)));
  }
  return found;
}

std::vector<vtkIsopointSampleArray> vtkListIsopointArrays(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, const std::vector<std::string>& nearest,
  std::set<std::string>& dropped)
{
  Arrays found;
  for (vtkIsopointSampleArray& array : commonOfBlocks(processes, blocks,
         [&](const vtkIsopointBlock& block) { return arraysOf(block, nearest); }))
  {
    if (array.Components == 0)
    {
      dropped.insert(array.Name);
      continue;
    }
    for (const vtkIsopointBlock& block : blocks)
    {
      array.Parts.push_back(block.Attributes->GetAbstractArray(array.Name.c_str()));
    }
    found.push_back(array);
  }
  return found;
}

isopoint::Message vtkDescribeLeftOut(const std::set<std::string>& names, const std::string& rule)
{
  std::string quoted;
  for (const std::string& name : names)
  {
    quoted += (quoted.empty() ? "\"" : ", \"") + name + "\"";
  }
  return { "left out " + quoted, "Left out of the output: " + quoted + ". " + rule,
    isopoint::Message::Note };
}

void vtkReadIsopointArray(const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::ProbedArray& probed)
{
  std::vector<vtkIsopointNumbers> parts;
  for (vtkAbstractArray* const part : array.Parts)
  {
    parts.emplace_back(vtkDataArray::SafeDownCast(part));
  }
  probed.components = array.Components;
  probed.valueError = array.AreIntegers ? isopoint::roundingError : 0.0;
  probed.read = [parts, sampleIds = vtkIsopointSampleIds(blocks)](
                  const std::uint64_t* ids, std::size_t count, int component, double* numbers)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto [block, tuple] = sampleIds.Find(static_cast<std::size_t>(ids[i]));
      numbers[i] = parts[block](tuple, static_cast<std::size_t>(component));
    }
  };
}

namespace
{

/// A number that an array can hold, without a fraction for integers, which get 0 if they cannot.
double heldBy(vtkDataArray* array, double number)
{
  if (vtkIsReal(array))
  {
    return number;
  }
  const bool isHeld = number >= array->GetDataTypeMin() && number <= array->GetDataTypeMax();
  return isHeld ? std::trunc(number) : 0.0;
}

/// @throws std::bad_alloc
vtkSmartPointer<vtkAbstractArray> newArray(
  const vtkIsopointSampleArray& array, int type, std::size_t tuples)
{
  auto result = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  result->SetName(array.Name.c_str());
  result->SetNumberOfComponents(array.Components);
  if (!array.Parts.empty())
  {
    result->CopyComponentNames(array.Parts.front());
  }
  vtkAllocateTuples(result, static_cast<vtkIdType>(tuples));
  return result;
}

void copyTuple(vtkAbstractArray* from, std::size_t sample, vtkAbstractArray* to, std::size_t place)
{
  const auto source = static_cast<vtkIdType>(sample);
  const auto target = static_cast<vtkIdType>(place);
  if (from->GetDataType() == to->GetDataType())
  {
    to->SetTuple(target, source, from); // double does not hold all integers of 64 bits
    return;
  }
  for (int component = 0; component < to->GetNumberOfComponents(); ++component)
  {
    vtkSetIsopointNumber(vtkDataArray::SafeDownCast(to), target, component,
      vtkDataArray::SafeDownCast(from)->GetComponent(source, component));
  }
}

using Ids = std::vector<std::uint64_t>;
constexpr std::uint64_t noSample = std::numeric_limits<std::uint64_t>::max();

/// Reads an array at samples, which other ranks may have.
class SampleValues
{
public:
  /// Collective.
  /// @param ids of the samples, or noSample
  SampleValues(isopoint::ProcessGroup& processes, const vtkIsopointSampleArray& array,
    const std::vector<vtkIsopointBlock>& blocks, const Ids& ids)
    : Parts(array.Parts.begin(), array.Parts.end())
    , Own(blocks)
  {
    if (processes.size() > 1)
    {
      this->Fetch(processes, array, ids);
    }
  }

  void CopyTo(vtkAbstractArray* array, std::size_t place, std::uint64_t id) const
  {
    if (this->Firsts.empty())
    {
      const auto [block, tuple] = this->Own.Find(static_cast<std::size_t>(id));
      copyTuple(this->Parts[block], tuple, array, place);
      return;
    }
    const auto index = static_cast<std::uint64_t>(
      std::lower_bound(this->Fetched.begin(), this->Fetched.end(), id) - this->Fetched.begin());
    const std::size_t rank = isopoint::rankAt(this->Firsts, index);
    copyTuple(this->Parts[rank], index - this->Firsts[rank], array, place);
  }

private:
  void Fetch(isopoint::ProcessGroup& processes, const vtkIsopointSampleArray& array, const Ids& ids)
  {
    this->Fetched = ids;
    isopoint::keepUnique(this->Fetched);
    if (!this->Fetched.empty() && this->Fetched.back() == noSample)
    {
      this->Fetched.pop_back();
    }
    std::vector<Ids> wanted; // by rank; ids count from its first sample
    std::uint64_t begin = 0;
    auto next = this->Fetched.begin();
    for (const std::uint64_t count : processes.gather(std::uint64_t{ this->Own.GetCount() }))
    {
      this->Firsts.push_back(static_cast<std::uint64_t>(next - this->Fetched.begin()));
      wanted.emplace_back();
      for (; next != this->Fetched.end() && *next < begin + count; ++next)
      {
        wanted.back().push_back(*next - begin);
      }
      begin += count;
    }
    std::vector<isopoint::ByteBuffer> answers;
    for (const Ids& asked : processes.exchange(wanted))
    {
      const vtkSmartPointer<vtkAbstractArray> values = newArray(array, array.Type, asked.size());
      for (std::size_t i = 0; i < asked.size(); ++i)
      {
        const auto [block, tuple] = this->Own.Find(static_cast<std::size_t>(asked[i]));
        copyTuple(this->Parts[block], tuple, values, i);
      }
      vtkNew<vtkPointData> attributes;
      attributes->AddArray(values);
      answers.push_back(vtkWriteIsopointArrays(attributes));
    }
    this->Parts.clear();
    for (const isopoint::ByteBuffer& bytes : processes.exchange(answers))
    {
      this->Parts.emplace_back(vtkReadIsopointArrays(bytes)->GetAbstractArray(0));
    }
  }

  std::vector<vtkSmartPointer<vtkAbstractArray>> Parts; // by block, or by rank
  vtkIsopointSampleIds Own;
  Ids Fetched; // ascending
  Ids Firsts;  // of the ranks in these; empty for one rank
};

/// The values of an array at samples. Numbers are `nothing` where there is none.
vtkSmartPointer<vtkAbstractArray> valuesAt(isopoint::ProcessGroup& processes,
  const vtkIsopointSampleArray& array, const std::vector<vtkIsopointBlock>& blocks, const Ids& ids,
  double nothing)
{
  const SampleValues values(processes, array, blocks, ids);
  vtkSmartPointer<vtkAbstractArray> result = newArray(array, array.Type, ids.size());
  auto* const numbers = vtkDataArray::SafeDownCast(result);
  const double held = numbers ? heldBy(numbers, nothing) : 0.0;
  for (std::size_t place = 0; place < ids.size(); ++place)
  {
    if (ids[place] != noSample)
    {
      values.CopyTo(result, place, ids[place]);
      continue;
    }
    for (int component = 0; numbers && component < array.Components; ++component)
    {
      vtkSetIsopointNumber(numbers, static_cast<vtkIdType>(place), component, held);
    }
  }
  return result;
}

/// What to probe for the nearest samples of an array.
isopoint::ProbedArray probedIds(const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, std::uint64_t* ids)
{
  isopoint::ProbedArray probed;
  if (!array.AreIntegers)
  {
    vtkReadIsopointArray(array, blocks, probed);
  }
  else // all are finite, as is text
  {
    probed.read = [](const std::uint64_t*, std::size_t count, int, double* numbers)
    { std::fill_n(numbers, count, 0.0); };
  }
  probed.isNearest = true;
  probed.writeNearest = [ids](std::size_t place, const std::uint64_t* id)
  { ids[place] = id ? *id : noSample; };
  return probed;
}

/// The range of a component in the samples of this rank that are in use.
std::pair<double, double> rangeOf(
  const vtkIsopointSampleArray& array, const std::vector<vtkIsopointBlock>& blocks, int component)
{
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (std::size_t block = 0; block < blocks.size(); ++block)
  {
    auto* const part = vtkDataArray::SafeDownCast(array.Parts[block]);
    vtkUnsignedCharArray* const ghosts = blocks[block].Ghosts;
    for (vtkIdType i = 0; i < part->GetNumberOfTuples(); ++i)
    {
      if (!ghosts || (ghosts->GetValue(i) & vtkIsopointBlock::Excluding) == 0)
      {
        const double number = part->GetComponent(i, component);
        least = std::min(least, number);
        greatest = std::max(greatest, number);
      }
    }
  }
  return { least, greatest };
}

/// Limits the values of integers to the range of all samples. Collective.
void limit(isopoint::ProcessGroup& processes, const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::ProbedArray& probed)
{
  if (processes.size() == 1)
  {
    probed.range = isopoint::foundOnce(array.Components,
      [&array, &blocks](int component) { return rangeOf(array, blocks, component); });
    return;
  }
  std::vector<std::pair<double, double>> ranges;
  for (int component = 0; component < array.Components; ++component)
  {
    const auto [least, greatest] = rangeOf(array, blocks, component);
    ranges.emplace_back(isopoint::fromOrderedKey(~processes.maximum(~isopoint::orderedKey(least))),
      isopoint::fromOrderedKey(processes.maximum(isopoint::orderedKey(greatest))));
  }
  probed.range = [ranges](int component) { return ranges[static_cast<std::size_t>(component)]; };
}

} // namespace

std::vector<vtkSmartPointer<vtkAbstractArray>> vtkProbeIsopointArrays(
  isopoint::ProcessGroup& processes, const std::vector<vtkIsopointSampleArray>& arrays,
  const std::vector<vtkIsopointBlock>& blocks, const isopoint::ProbeOptions& options,
  std::size_t places, const std::function<void(const std::vector<isopoint::ProbedArray>&)>& probe)
{
  std::vector<vtkSmartPointer<vtkAbstractArray>> results;
  std::vector<isopoint::ProbedArray> probed;
  std::vector<Ids> ids(arrays.size()); // of the nearest samples
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    const vtkIsopointSampleArray& array = arrays[i];
    if (array.IsNearest || options.method == isopoint::PlaceMethod::Nearest)
    {
      ids[i].assign(places, noSample);
      results.emplace_back();
      probed.push_back(probedIds(array, blocks, ids[i].data()));
      continue;
    }
    results.push_back(newArray(array, VTK_DOUBLE, places));
    vtkReadIsopointArray(array, blocks, probed.emplace_back());
    probed.back().values =
      vtkAOSDataArrayTemplate<double>::FastDownCast(results.back())->GetPointer(0);
    if (array.AreIntegers)
    {
      limit(processes, array, blocks, probed.back());
    }
  }
  probe(probed);
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    if (!results[i])
    {
      results[i] = valuesAt(processes, arrays[i], blocks, ids[i], options.outsideNumber);
    }
  }
  return results;
}

void vtkReplaceIsopointNumbers(vtkDataArray* found, vtkDataArray* array)
{
  if (array->GetDataType() == found->GetDataType() && !vtkIsReal(array))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      array->SetTuple(i, i, found); // double does not hold all integers of 64 bits
    }
    return;
  }
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      const double number = found->GetComponent(i, component);
      if (std::isfinite(number))
      {
        vtkSetIsopointNumber(array, i, component, number);
      }
    }
  }
}
