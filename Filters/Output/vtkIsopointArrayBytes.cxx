// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointArrayBytes.h"

#include "Input/vtkIsopointAllocation.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace
{

template <class T>
void write(std::vector<char>& bytes, const T& value)
{
  const char* const begin = reinterpret_cast<const char*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof(T));
}

void write(std::vector<char>& bytes, const std::string& text)
{
  write(bytes, static_cast<std::uint64_t>(text.size()));
  bytes.insert(bytes.end(), text.begin(), text.end());
}

template <class T>
T read(const char*& bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  bytes += sizeof(T);
  return value;
}

std::string readText(const char*& bytes)
{
  const auto size = static_cast<std::size_t>(read<std::uint64_t>(bytes));
  const std::string text(bytes, size);
  bytes += size;
  return text;
}

bool canBeSent(vtkAbstractArray* array)
{
  return array->GetName() &&
         (vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array));
}

vtkIsopointArrayHeader headerOf(vtkAbstractArray* array, int attribute)
{
  vtkIsopointArrayHeader header;
  header.Name = array->GetName();
  header.Type = array->GetDataType();
  header.Components = array->GetNumberOfComponents();
  header.Attribute = attribute;
  for (int i = 0; i < header.Components && array->HasAComponentName(); ++i)
  {
    const char* const name = array->GetComponentName(i);
    header.ComponentNames.emplace_back(name ? name : "");
  }
  return header;
}

/// Whether a double does not hold all values of an array's type.
bool isWideInteger(vtkDataArray* array)
{
  return array->GetDataType() != VTK_DOUBLE && array->GetDataTypeSize() == 8;
}

} // namespace

bool vtkIsopointArrayHeader::HasSameKind(const vtkIsopointArrayHeader& other) const
{
  return this->Name == other.Name && this->Type == other.Type &&
         this->Components == other.Components;
}

std::vector<vtkIsopointArrayHeader> vtkListIsopointArrays(
  vtkDataSetAttributes* attributes, vtkIdType count)
{
  std::vector<vtkIsopointArrayHeader> headers;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = attributes->GetAbstractArray(i);
    if (canBeSent(array) && array->GetNumberOfTuples() == count)
    {
      headers.push_back(headerOf(array, attributes->IsArrayAnAttribute(i)));
    }
  }
  return headers;
}

std::vector<vtkIsopointArrayHeader> vtkIntersectIsopointArrays(
  const std::vector<std::vector<vtkIsopointArrayHeader>>& lists)
{
  if (lists.empty())
  {
    return {};
  }
  std::vector<vtkIsopointArrayHeader> common;
  for (vtkIsopointArrayHeader header : lists.front())
  {
    const bool isInAll = std::all_of(lists.begin(), lists.end(),
      [&header](const std::vector<vtkIsopointArrayHeader>& list)
      {
        const auto found = std::find_if(list.begin(), list.end(),
          [&header](const vtkIsopointArrayHeader& other) { return header.HasSameKind(other); });
        if (found != list.end() && found->Attribute != header.Attribute)
        {
          header.Attribute = -1;
        }
        return found != list.end();
      });
    if (isInAll)
    {
      common.push_back(header);
    }
  }
  return common;
}

std::vector<char> vtkWriteIsopointArrayHeaders(const std::vector<vtkIsopointArrayHeader>& headers)
{
  std::vector<char> bytes;
  for (const vtkIsopointArrayHeader& header : headers)
  {
    write(bytes, header.Name);
    write(bytes, header.Type);
    write(bytes, header.Components);
    write(bytes, header.Attribute);
    write(bytes, static_cast<std::uint64_t>(header.ComponentNames.size()));
    for (const std::string& name : header.ComponentNames)
    {
      write(bytes, name);
    }
  }
  return bytes;
}

std::vector<vtkIsopointArrayHeader> vtkReadIsopointArrayHeaders(const std::vector<char>& bytes)
{
  std::vector<vtkIsopointArrayHeader> headers;
  const char* next = bytes.data();
  while (next != bytes.data() + bytes.size())
  {
    vtkIsopointArrayHeader header;
    header.Name = readText(next);
    header.Type = read<int>(next);
    header.Components = read<int>(next);
    header.Attribute = read<int>(next);
    const auto names = read<std::uint64_t>(next);
    for (std::uint64_t i = 0; i < names; ++i)
    {
      header.ComponentNames.push_back(readText(next));
    }
    headers.push_back(header);
  }
  return headers;
}

vtkSmartPointer<vtkAbstractArray> vtkNewIsopointArray(
  const vtkIsopointArrayHeader& header, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(header.Type));
  array->SetName(header.Name.c_str());
  array->SetNumberOfComponents(header.Components);
  for (std::size_t i = 0; i < header.ComponentNames.size(); ++i)
  {
    array->SetComponentName(static_cast<vtkIdType>(i), header.ComponentNames[i].c_str());
  }
  vtkAllocateTuples(array, tuples);
  return array;
}

void vtkWriteIsopointTuple(vtkAbstractArray* array, vtkIdType tuple, std::vector<char>& bytes)
{
  const int components = array->GetNumberOfComponents();
  if (auto* const strings = vtkStringArray::SafeDownCast(array))
  {
    for (int i = 0; i < components; ++i)
    {
      write(bytes, std::string(strings->GetValue(components * tuple + i)));
    }
    return;
  }
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  for (int i = 0; i < components; ++i)
  {
    // Wide integers as such: a double would round them.
    if (isWideInteger(numbers))
    {
      write(bytes, numbers->GetVariantValue(components * tuple + i).ToUnsignedLongLong());
    }
    else
    {
      write(bytes, numbers->GetComponent(tuple, i));
    }
  }
}

const char* vtkReadIsopointTuple(const char* bytes, vtkAbstractArray* array, vtkIdType tuple)
{
  const int components = array->GetNumberOfComponents();
  if (auto* const strings = vtkStringArray::SafeDownCast(array))
  {
    for (int i = 0; i < components; ++i)
    {
      strings->SetValue(components * tuple + i, readText(bytes));
    }
    return bytes;
  }
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  for (int i = 0; i < components; ++i)
  {
    if (isWideInteger(numbers))
    {
      // The stored bits, signed or not.
      const auto value = read<unsigned long long>(bytes);
      std::memcpy(
        static_cast<unsigned long long*>(numbers->GetVoidPointer(0)) + components * tuple + i,
        &value, sizeof(value));
    }
    else
    {
      numbers->SetComponent(tuple, i, read<double>(bytes));
    }
  }
  return bytes;
}
