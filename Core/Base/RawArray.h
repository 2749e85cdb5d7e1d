// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_RawArray_h
#define isopoint_RawArray_h

#include "Core/Base/Pages.h"

#include <cassert>
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
  /// taken, nor set aside, for pages that are not, as far as the system can. Its size must stay.
  /// @param first, count the elements that will all be written
  /// @throws std::bad_alloc
  void spread(std::size_t size, std::size_t first, std::size_t count)
  {
    const std::size_t bytes = bytesOf(size);
    this->release();
    this->Elements = checked(reserveSpread(bytes));
    this->Size = this->Capacity = size;
    this->IsSpread = true;
    preferHugePages(this->Elements + first, bytesOf(count), alwaysMapped);
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
  /// From this size on, glibc maps each allocation separately, whatever its settings, so that it
  /// can grow by remapping.
  static constexpr std::size_t alwaysMapped = std::size_t{ 1 } << 25;

  static std::size_t bytesOf(std::size_t count)
  {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T))
    {
      throw std::bad_alloc();
    }
    return count * sizeof(T);
  }

  static T* checked(void* memory)
  {
    if (!memory)
    {
      throw std::bad_alloc();
    }
    return static_cast<T*>(memory);
  }

  void reallocate(std::size_t capacity)
  {
    assert(!this->IsSpread); // its memory is not that of realloc
    const std::size_t bytes = bytesOf(capacity);
    this->Elements = checked(std::realloc(static_cast<void*>(this->Elements), bytes));
    this->Capacity = capacity;
    preferHugePages(this->Elements, bytes, alwaysMapped);
  }

  void release()
  {
    if (this->IsSpread)
    {
      releaseSpread(this->Elements, this->Capacity * sizeof(T));
    }
    else
    {
      std::free(this->Elements);
    }
    this->Elements = nullptr;
    this->Size = this->Capacity = 0;
    this->IsSpread = false;
  }

  void swap(RawArray& other) noexcept
  {
    std::swap(this->IsSpread, other.IsSpread);
    std::swap(this->Elements, other.Elements);
    std::swap(this->Size, other.Size);
    std::swap(this->Capacity, other.Capacity);
  }

  T* Elements = nullptr;
  std::size_t Size = 0;
  std::size_t Capacity = 0;
  bool IsSpread = false; // made by spread()
};

} // namespace isopoint

#endif
