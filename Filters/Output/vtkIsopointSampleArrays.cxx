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
#include <cstring>
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
    if (!array->GetName() ||
        std::strcmp(array->GetName(), vtkDataSetAttributes::GhostArrayName()) == 0 ||
        attribute == vtkDataSetAttributes::GLOBALIDS ||
        attribute == vtkDataSetAttributes::PEDIGREEIDS)
    {
      continue;
    }
    const bool isUsed =
      vtkDataArray::SafeDownCast(array) && array->GetNumberOfTuples() == block.GetNumberOfSamples();
    const int type = array->GetDataType();
    arrays.push_back({ array->GetName(), isUsed ? array->GetNumberOfComponents() : 0, type,
      attribute, type != VTK_FLOAT && type != VTK_DOUBLE, {} });
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

} // namespace

std::vector<vtkIsopointSampleArray> vtkListIsopointArrays(isopoint::ProcessGroup& processes,
  const std::vector<vtkIsopointBlock>& blocks, std::set<std::string>& dropped)
{
  Arrays all;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    all = i == 0 ? arraysOf(blocks[i]) : common(all, arraysOf(blocks[i]));
  }
  if (processes.size() > 1)
  {
    all = commonOfRanks(processes, all, !blocks.empty());
  }
  Arrays found;
  for (vtkIsopointSampleArray& array : all)
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
  const int type = array->GetDataType();
  if (type == VTK_FLOAT || type == VTK_DOUBLE)
  {
    return number;
  }
  const bool isHeld = number >= array->GetDataTypeMin() && number <= array->GetDataTypeMax();
  return isHeld ? std::trunc(number) : 0.0;
}

} // namespace

vtkIsopointProbedArray::vtkIsopointProbedArray(const vtkIsopointSampleArray& array,
  const std::vector<vtkIsopointBlock>& blocks, const isopoint::ProbeOptions& options,
  vtkIdType places, bool isAlone)
  : Type(options.method == isopoint::PlaceMethod::Nearest ? array.Type : VTK_DOUBLE)
{
  // Bits share bytes, so that threads cannot write them; ranks exchange doubles.
  const bool isTaken = this->Type != VTK_DOUBLE && this->Type != VTK_BIT && isAlone;
  this->Result = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(isTaken ? this->Type : VTK_DOUBLE));
  this->Result->SetName(array.Name.c_str());
  this->Result->SetNumberOfComponents(array.Components);
  if (!array.Parts.empty())
  {
    this->Result->CopyComponentNames(array.Parts.front());
  }
  vtkAllocateTuples(this->Result, places);
  vtkReadIsopointArray(array, blocks, this->Probed);
  if (!isTaken)
  {
    this->Probed.values =
      vtkAOSDataArrayTemplate<double>::FastDownCast(this->Result)->GetPointer(0);
    return;
  }
  this->Probed.take = [result = this->Result.Get(), parts = array.Parts,
                        sampleIds = vtkIsopointSampleIds(blocks),
                        nothing = heldBy(this->Result, options.outsideNumber)](
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
}

vtkSmartPointer<vtkDataArray> vtkIsopointProbedArray::Finish()
{
  if (this->Result->GetDataType() == this->Type)
  {
    return this->Result;
  }
  const auto converted =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Type));
  converted->SetName(this->Result->GetName());
  converted->SetNumberOfComponents(this->Result->GetNumberOfComponents());
  converted->CopyComponentNames(this->Result);
  vtkAllocateTuples(converted, this->Result->GetNumberOfTuples());
  for (vtkIdType i = 0; i < converted->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < converted->GetNumberOfComponents(); ++component)
    {
      vtkSetIsopointNumber(
        converted, i, component, heldBy(converted, this->Result->GetComponent(i, component)));
    }
  }
  return converted;
}

void vtkReplaceIsopointNumbers(vtkDataArray* found, vtkDataArray* array)
{
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
