// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointSampleArrays.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/Base/ProcessGroup.h"
#include "Core/Contour.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Input/vtkIsopointNumbers.h"
#include "Output/vtkIsopointOutputArrays.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace
{

using Arrays = std::vector<vtkIsopointSampleArray>;

/// The arrays of a block; those without numbers for all samples have no components.
Arrays arraysOf(const vtkIsopointBlock& block)
{
  Arrays arrays;
  vtkDataSetAttributes* const attributes = block.Attributes;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = attributes->GetAbstractArray(i);
    const int attribute = attributes->IsArrayAnAttribute(i);
    if (!array->GetName() || vtkIsGhostArrayName(array->GetName()) ||
        attribute == vtkDataSetAttributes::GLOBALIDS ||
        attribute == vtkDataSetAttributes::PEDIGREEIDS)
    {
      continue;
    }
    const bool isUsed =
      vtkDataArray::SafeDownCast(array) && array->GetNumberOfTuples() == block.GetNumberOfSamples();
    arrays.push_back({ array->GetName(), isUsed ? array->GetNumberOfComponents() : 0,
      array->GetDataType(), attribute, !vtkIsReal(array), {} });
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
    if (other == rest.end() || other->Components != array.Components)
    {
      array.Components = 0;
    }
    else
    {
      array.Type = other->Type == array.Type ? array.Type : VTK_DOUBLE;
      array.Attribute = other->Attribute == array.Attribute ? array.Attribute : -1;
      array.AreIntegers = array.AreIntegers && other->AreIntegers;
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
        !vtkIsReal(array), {} } };
    }).front();
  for (const vtkIsopointBlock& block : blocks)
  {
    found.Parts.push_back(vtkDataArray::SafeDownCast(choice.Find(block.Attributes)));
  }
  return found;
}

std::vector<vtkIsopointSampleArray> vtkListIsopointArrays(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, std::set<std::string>& dropped)
{
  Arrays found;
  for (vtkIsopointSampleArray& array : commonOfBlocks(processes, blocks, arraysOf))
  {
    if (array.Components == 0)
    {
      dropped.insert(array.Name);
      continue;
    }
    for (const vtkIsopointBlock& block : blocks)
    {
      array.Parts.push_back(block.Attributes->GetArray(array.Name.c_str()));
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
  std::vector<vtkIsopointNumbers> parts(array.Parts.begin(), array.Parts.end());
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

/// Memory for an array at places: doubles unless samples can be copied.
/// @param type of the result
vtkSmartPointer<vtkDataArray> newArrayAt(
  vtkIdType places, const vtkIsopointSampleArray& array, int type, bool isAlone)
{
  // Bits share bytes, so that threads cannot write them; ranks exchange doubles.
  const bool isCopied = type != VTK_BIT && isAlone;
  auto result = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(isCopied ? type : VTK_DOUBLE));
  result->SetName(array.Name.c_str());
  result->SetNumberOfComponents(array.Components);
  if (!array.Parts.empty())
  {
    result->CopyComponentNames(array.Parts.front());
  }
  vtkAllocateTuples(result, places);
  return result;
}

/// What to probe for an array.
isopoint::ProbedArray probedArray(const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, double nothing, vtkDataArray* result)
{
  isopoint::ProbedArray probed;
  vtkReadIsopointArray(array, blocks, probed);
  if (auto* const doubles = vtkAOSDataArrayTemplate<double>::FastDownCast(result))
  {
    probed.values = doubles->GetPointer(0);
    return probed;
  }
  probed.writeNearest = [result, parts = array.Parts, sampleIds = vtkIsopointSampleIds(blocks),
                          nothing = heldBy(result, nothing)](
                          std::size_t place, const std::uint64_t* id)
  {
    const auto to = static_cast<vtkIdType>(place);
    if (id)
    {
      const auto [block, tuple] = sampleIds.Find(static_cast<std::size_t>(*id));
      result->SetTuple(to, static_cast<vtkIdType>(tuple), parts[block]);
      return;
    }
    for (int component = 0; component < result->GetNumberOfComponents(); ++component)
    {
      vtkSetIsopointNumber(result, to, component, nothing);
    }
  };
  return probed;
}

/// An array in a type. @throws std::bad_alloc
vtkSmartPointer<vtkDataArray> converted(const vtkSmartPointer<vtkDataArray>& array, int type)
{
  if (array->GetDataType() == type)
  {
    return array;
  }
  auto result = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  result->SetName(array->GetName());
  result->SetNumberOfComponents(array->GetNumberOfComponents());
  result->CopyComponentNames(array);
  vtkAllocateTuples(result, array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < result->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < result->GetNumberOfComponents(); ++component)
    {
      vtkSetIsopointNumber(result, i, component, heldBy(result, array->GetComponent(i, component)));
    }
  }
  return result;
}

} // namespace

std::vector<vtkSmartPointer<vtkDataArray>> vtkProbeIsopointArrays(
  const std::vector<vtkIsopointSampleArray>& arrays, const std::vector<vtkIsopointBlock>& blocks,
  const isopoint::ProbeOptions& options, std::size_t places, bool isAlone,
  const std::function<void(const std::vector<isopoint::ProbedArray>&)>& probe)
{
  std::vector<vtkSmartPointer<vtkDataArray>> results;
  std::vector<isopoint::ProbedArray> probed;
  const auto typeOf = [&](const vtkIsopointSampleArray& array)
  { return options.method == isopoint::PlaceMethod::Nearest ? array.Type : VTK_DOUBLE; };
  for (const vtkIsopointSampleArray& array : arrays)
  {
    results.push_back(newArrayAt(static_cast<vtkIdType>(places), array, typeOf(array), isAlone));
    probed.push_back(probedArray(array, blocks, options.outsideNumber, results.back()));
  }
  probe(probed);
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    results[i] = converted(results[i], typeOf(arrays[i]));
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
