// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_RawArray_h
#define isopoint_RawArray_h

#include "Isopoint/Base/HugePages.h"

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

namespace isopoint
{

/// A growing array of trivial elements that are left uninitialized. Unlike std::vector, it does not
/// touch memory before the first write (from any thread), and growing a large one remaps its pages
/// instead of holding two copies.
template <class T>
class RawArray
{
  static_assert(std::is_trivially_copyable<T>::value, "elements are moved by their bytes");

public:
  RawArray() = default;
  RawArray(const RawArray&) = delete;
  RawArray& operator=(const RawArray&) = delete;
  RawArray(RawArray&& other) noexcept { this->swap(other); }
  RawArray& operator=(RawArray&& other) noexcept
  {
    this->swap(other);
    return *this;
  }
  ~RawArray() { this->release(); }

  /// Keeps the first min(size(), newSize) elements. @throws std::bad_alloc, the array unchanged.
  void resize(std::size_t newSize)
  {
    if (newSize > this->Capacity)
    {
      this->reallocate(newSize);
    }
    this->Size = newSize;
  }

  /// Gives back the memory behind the last element.
  void shrinkToFit()
  {
    if (this->Capacity > this->Size && this->Size > 0)
    {
      this->reallocate(this->Size);
    }
  }

  /// Makes an empty array one of this many elements of which few will be written: no memory is
  /// taken, nor set aside, for pages that are not, as far as the system can. Its size stays.
  /// @param first, count the elements that will all be written
  /// @throws std::bad_alloc
  void spread(std::size_t size, std::size_t first, std::size_t count)
  {
    if (size > std::numeric_limits<std::size_t>::max() / sizeof(T))
    {
      throw std::bad_alloc();
    }
    this->release();
    if (size == 0)
    {
      return;
    }
    this->Elements = static_cast<T*>(reserveSpread(size * sizeof(T)));
    if (!this->Elements)
    {
      throw std::bad_alloc();
    }
    this->Size = this->Capacity = size;
    this->SpreadBytes = size * sizeof(T);
    preferHugePagesInside(this->Elements, this->SpreadBytes, first * sizeof(T), count * sizeof(T));
  }

  /// Gives back the memory of some elements, as far as the system can, whose values are lost.
  void discard(std::size_t begin, std::size_t end)
  {
    discardPages(static_cast<void*>(this->Elements + begin), (end - begin) * sizeof(T));
  }

  std::size_t size() const { return this->Size; }
  T* data() { return this->Elements; }
  const T* data() const { return this->Elements; }
  T& operator[](std::size_t i) { return this->Elements[i]; }
  const T& operator[](std::size_t i) const { return this->Elements[i]; }

private:
  void reallocate(std::size_t capacity)
  {
    if (capacity > std::numeric_limits<std::size_t>::max() / sizeof(T))
    {
      throw std::bad_alloc();
    }
    void* grown = std::realloc(static_cast<void*>(this->Elements), capacity * sizeof(T));
    if (!grown)
    {
      throw std::bad_alloc();
    }
    preferHugePages(grown, capacity * sizeof(T));
    this->Elements = static_cast<T*>(grown);
    this->Capacity = capacity;
  }

  void release()
  {
    if (this->SpreadBytes > 0)
    {
      releaseSpread(this->Elements, this->SpreadBytes);
    }
    else
    {
      std::free(this->Elements);
    }
    this->Elements = nullptr;
    this->Size = this->Capacity = this->SpreadBytes = 0;
  }

  void swap(RawArray& other) noexcept
  {
    std::swap(this->SpreadBytes, other.SpreadBytes);
    std::swap(this->Elements, other.Elements);
    std::swap(this->Size, other.Size);
    std::swap(this->Capacity, other.Capacity);
  }

  T* Elements = nullptr;
  std::size_t Size = 0;
  std::size_t Capacity = 0;
  std::size_t SpreadBytes = 0; // of an array made by spread(), or 0
};

} // namespace isopoint

#endif
