// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)
#define ISOPOINT_HAS_PAGES
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace isopoint
{

// Virtual memory that saves memory and page faults; plain memory on systems without it.

#ifdef ISOPOINT_HAS_PAGES

/// In bytes.
inline std::uintptr_t pageSize()
{
  return static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
}

/// Reserves addresses of which few will be written: only pages that are written take memory.
/// @returns null on failure
inline void* reserveSpread(std::size_t bytes)
{
  int flags = MAP_PRIVATE | MAP_ANONYMOUS;
#ifdef MAP_NORESERVE
  flags |= MAP_NORESERVE;
#endif
  void* const memory = mmap(nullptr, bytes > 0 ? bytes : 1, PROT_READ | PROT_WRITE, flags, -1, 0);
  if (memory == MAP_FAILED)
  {
    return nullptr;
  }
#ifdef MADV_NOHUGEPAGE
  static_cast<void>(madvise(memory, bytes, MADV_NOHUGEPAGE));
#endif
  return memory;
}

inline void releaseSpread(void* memory, std::size_t bytes)
{
  static_cast<void>(munmap(memory, bytes > 0 ? bytes : 1));
}

/// Frees the memory of the whole pages in a range and loses their content; addresses stay valid.
inline void discardPages(void* begin, std::size_t bytes)
{
#ifdef __linux__
  constexpr int discarded = MADV_DONTNEED; // takes effect at once
#else
  constexpr int discarded = MADV_FREE; // MADV_DONTNEED keeps the content there
#endif
  const std::uintptr_t page = pageSize();
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t last = (address + bytes) / page * page;
  if (first < last)
  {
    static_cast<void>(
      madvise(static_cast<char*>(begin) + (first - address), last - first, discarded));
  }
}

#else

/// Plain memory. Windows counts pages that are never written against its commit limit, so a large
/// cloud can end in std::bad_alloc there.
inline void* reserveSpread(std::size_t bytes)
{
  return std::malloc(bytes > 0 ? bytes : 1);
}

inline void releaseSpread(void* memory, std::size_t)
{
  std::free(memory);
}

inline void discardPages(void*, std::size_t) {}

#endif

/// Asks for huge pages behind memory of more than `least` bytes that will be written: this saves
/// page faults at the first writes and page walks at reads. Memory that is never written still
/// takes no pages, except for the rest of a huge one.
inline void preferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
  [[maybe_unused]] std::size_t least)
{
#ifdef MADV_HUGEPAGE
  if (bytes > least)
  {
    // From the page that holds the allocator's own data: advice for a part of a mapping splits it,
    // and it could no longer grow by remapping.
    const std::size_t before = reinterpret_cast<std::uintptr_t>(memory) % pageSize();
    static_cast<void>(madvise(static_cast<char*>(memory) - before, before + bytes, MADV_HUGEPAGE));
  }
#endif
}

/// A growing array of trivial, uninitialized elements. Unlike std::vector, it does not touch memory
/// before the first write (from any thread), and a large array grows by remapping, without a copy.
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

  /// Keeps the first min(size(), newSize) elements. @throws std::bad_alloc, the array unchanged
  void resize(std::size_t newSize)
  {
    if (newSize > this->Capacity)
    {
      this->reallocate(newSize);
    }
    this->Size = newSize;
  }

  void shrinkToFit()
  {
    if (this->Capacity > this->Size && this->Size > 0)
    {
      this->reallocate(this->Size);
    }
  }

  /// Gives an empty array a fixed size of which few elements will be written; see reserveSpread().
  /// @param first, count elements that will all be written
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

  /// Frees the memory of elements, as far as the system can, and loses their values.
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
  /// glibc always maps allocations of this size on their own, so that they can grow by remapping.
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
    assert(!this->IsSpread); // realloc() did not allocate it
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
  bool IsSpread = false; // allocated by reserveSpread()
};

} // namespace isopoint
