// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Library/isopoint.h"

#include "Core/Failure.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>

namespace isopoint
{

/// The types of numbers, by isopoint_type.
using NumberTypes = std::tuple<float, double, std::int8_t, std::uint8_t, std::int16_t,
  std::uint16_t, std::int32_t, std::uint32_t, std::int64_t, std::uint64_t>;

/// Calls visit with a number of a type, one that ArrayReader has checked.
template <std::int32_t Type = ISOPOINT_FLOAT, class Visitor>
decltype(auto) withType(std::int32_t type, const Visitor& visit)
{
  if constexpr (Type < ISOPOINT_UINT64)
  {
    if (type != Type)
    {
      return withType<Type + 1>(type, visit);
    }
  }
  return visit(std::tuple_element_t<Type, NumberTypes>{});
}

inline bool isFloatingPoint(std::int32_t type)
{
  return type == ISOPOINT_FLOAT || type == ISOPOINT_DOUBLE;
}

inline std::size_t sizeOfType(std::int32_t type)
{
  return withType(type, [](auto number) { return sizeof(number); });
}

/// Reads the numbers of an array. Thread-safe.
class ArrayReader
{
public:
  /// @param name of the contents, for messages
  /// @throws UsageError if the array is inconsistent
  ArrayReader(const isopoint_array* array, const char* name)
    : Described(std::string("The array of ") + name)
  {
    if (!array)
    {
      throw UsageError(this->Described + " is null. Pass an isopoint_array.", UsageError::Array);
    }
    this->Array = *array;
    if (array->components < 1 || array->count < 0 || (array->count > 0 && !array->data))
    {
      throw UsageError(this->Described + " has " + std::to_string(array->count) + " tuples of " +
                         std::to_string(array->components) + " components" +
                         (array->data ? "" : " and no data") +
                         ". Pass at least one component, and memory for all tuples.",
        UsageError::Array);
    }
    if (array->type < ISOPOINT_FLOAT || array->type > ISOPOINT_UINT64)
    {
      throw UsageError(this->Described + " has the unknown type " + std::to_string(array->type) +
                         ". Use an isopoint_type.",
        UsageError::Array);
    }
    const std::size_t size = sizeOfType(array->type);
    const std::int64_t most = std::numeric_limits<std::int64_t>::max() / array->components;
    if (array->count > most / static_cast<std::int64_t>(size))
    {
      throw UsageError(this->Described + " has " + std::to_string(array->count) +
                         " tuples. Pass no more than memory can hold.",
        UsageError::Array);
    }
    this->ComponentStride =
      array->component_stride == 0 ? size : static_cast<std::uint64_t>(array->component_stride);
    this->Stride = array->stride == 0
                     ? this->ComponentStride * static_cast<std::uint64_t>(array->components)
                     : static_cast<std::uint64_t>(array->stride);
  }

  std::int32_t type() const { return this->Array.type; }
  std::size_t count() const { return static_cast<std::size_t>(this->Array.count); }
  int components() const { return this->Array.components; }

  /// @throws UsageError if the numbers are integers
  void requireFloatingPoint() const
  {
    if (!isFloatingPoint(this->type()))
    {
      throw UsageError(
        this->Described + " holds integers. Pass float or double.", UsageError::Array);
    }
  }

  /// @throws UsageError unless there are `count` tuples of `components` numbers
  void require(std::size_t count, int components) const
  {
    if (this->count() != count || this->components() != components)
    {
      throw UsageError(this->Described + " has " + std::to_string(this->count()) + " tuples of " +
                         std::to_string(this->components()) + " components. Pass " +
                         std::to_string(count) + " of " + std::to_string(components) + ".",
        UsageError::Array);
    }
  }

  /// All numbers of an array of type T, or null if they are not contiguous and aligned.
  template <class T>
  const T* contiguous() const
  {
    const bool isContiguous =
      this->ComponentStride == sizeof(T) &&
      this->Stride == sizeof(T) * static_cast<std::uint64_t>(this->components()) &&
      reinterpret_cast<std::uintptr_t>(this->Array.data) % alignof(T) == 0;
    return isContiguous ? static_cast<const T*>(this->Array.data) : nullptr;
  }

  /// A number of an array of type T.
  template <class T>
  T at(std::size_t tuple, int component) const
  {
    const std::uint64_t offset =
      tuple * this->Stride + static_cast<std::uint64_t>(component) * this->ComponentStride;
    T number;
    std::memcpy(&number,
      static_cast<const char*>(this->Array.data) + static_cast<std::int64_t>(offset),
      sizeof(number));
    return number;
  }

  /// A number of an array of any type.
  double at(std::size_t tuple, int component) const
  {
    return withType(this->Array.type, [&](auto number)
      { return static_cast<double>(this->at<decltype(number)>(tuple, component)); });
  }

private:
  std::string Described;
  isopoint_array Array;
  // Modulo 2^64: strides may be negative.
  std::uint64_t Stride;
  std::uint64_t ComponentStride;
};

/// @param size of the memory for results, in bytes
/// @throws UsageError unless it holds `count` tuples of `bytes` each
inline void requireMemory(const void* memory, std::uint64_t size, const char* results,
  std::size_t count, std::uint64_t bytes)
{
  if ((memory ? size : 0) / bytes < count)
  {
    throw UsageError(std::string("The memory for ") + results +
                       (memory ? " has " + std::to_string(size) + " bytes" : " is null") +
                       ". Pass " + std::to_string(count) + " times " + std::to_string(bytes) +
                       " bytes.",
      UsageError::Array);
  }
}

} // namespace isopoint
