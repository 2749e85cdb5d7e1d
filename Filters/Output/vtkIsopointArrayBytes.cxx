// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointArrayBytes.h"

#include "Common/vtkIsopointArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cstddef>
#include <string>

using isopoint::ByteBuffer;

namespace
{

std::string textOf(const char* text)
{
  return text ? text : "";
}

bool isSent(vtkDataSetAttributes* attributes, int index)
{
  vtkAbstractArray* const array = attributes->GetAbstractArray(index);
  const bool isNamed = array->GetName() && !vtkIsGhostArrayName(array->GetName());
  const bool hasKnownValues =
    vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array);
  return index + 1 == attributes->GetNumberOfArrays() ||
         (isNamed && hasKnownValues &&
           attributes->IsArrayAnAttribute(index) != vtkDataSetAttributes::GLOBALIDS);
}

/// The bytes of a contiguous numeric array.
std::size_t sizeOf(vtkAbstractArray* array)
{
  const auto values = static_cast<std::size_t>(array->GetNumberOfValues());
  constexpr std::size_t bits = 8;
  return array->GetDataType() == VTK_BIT
           ? (values + bits - 1) / bits
           : values * static_cast<std::size_t>(array->GetDataTypeSize());
}

void writeArray(vtkAbstractArray* array, ByteBuffer& bytes)
{
  const int components = array->GetNumberOfComponents();
  isopoint::appendText(bytes, textOf(array->GetName()));
  isopoint::append(bytes, array->GetDataType());
  isopoint::append(bytes, components);
  isopoint::append(bytes, array->GetNumberOfTuples());
  for (int i = 0; i < components; ++i)
  {
    isopoint::appendText(bytes, textOf(array->GetComponentName(i)));
  }
  if (auto* const strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      isopoint::appendText(bytes, std::string(strings->GetValue(i)));
    }
    return;
  }
  isopoint::append(
    bytes, static_cast<const unsigned char*>(array->GetVoidPointer(0)), sizeOf(array));
}

vtkSmartPointer<vtkAbstractArray> readArray(isopoint::ByteReader& reader)
{
  const std::string name = reader.readText();
  const auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(reader.read<int>()));
  const auto components = reader.read<int>();
  const vtkIdType tuples = reader.read<vtkIdType>();
  array->SetName(name.empty() ? nullptr : name.c_str());
  array->SetNumberOfComponents(components);
  for (int i = 0; i < components; ++i)
  {
    const std::string componentName = reader.readText();
    if (!componentName.empty())
    {
      array->SetComponentName(i, componentName.c_str());
    }
  }
  vtkAllocateTuples(array, tuples);
  if (auto* const strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      strings->SetValue(i, reader.readText());
    }
    return array;
  }
  reader.read(static_cast<unsigned char*>(array->GetVoidPointer(0)), sizeOf(array));
  return array;
}

} // namespace

ByteBuffer vtkWriteIsopointArrays(vtkDataSetAttributes* attributes)
{
  ByteBuffer bytes;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (isSent(attributes, i))
    {
      isopoint::append(bytes, attributes->IsArrayAnAttribute(i));
      writeArray(attributes->GetAbstractArray(i), bytes);
    }
  }
  return bytes;
}

vtkSmartPointer<vtkPointData> vtkReadIsopointArrays(const ByteBuffer& bytes)
{
  auto attributes = vtkSmartPointer<vtkPointData>::New();
  isopoint::ByteReader reader(bytes);
  while (!reader.isAtEnd())
  {
    const auto attribute = reader.read<int>();
    vtkAddAttribute(attribute, readArray(reader), attributes);
  }
  return attributes;
}
