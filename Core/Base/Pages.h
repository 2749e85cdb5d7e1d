// SPDX-License-Identifier: GPL-3.0-or-later
// What the system offers to save memory and page faults; elsewhere plain memory, with its costs.
#ifndef isopoint_Pages_h
#define isopoint_Pages_h

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#if defined(__unix__) || defined(__APPLE__)
#define ISOPOINT_HAS_PAGES
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace isopoint
{

#ifdef ISOPOINT_HAS_PAGES

/// The size of the system's pages, in bytes.
inline std::uintptr_t pageSize()
{
  return static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
}

/// Addresses for this many bytes, most of which will never be written: only pages that are written
/// take memory, and none is set aside. @returns null if there are none
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

/// Gives back what reserveSpread() reserved.
inline void releaseSpread(void* memory, std::size_t bytes)
{
  static_cast<void>(munmap(memory, bytes > 0 ? bytes : 1));
}

/// Gives back the memory of the whole pages in a range, whose content is lost; its addresses stay.
inline void discardPages(void* begin, std::size_t bytes)
{
#ifdef __linux__
  constexpr int discarded = MADV_DONTNEED; // at once
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

/// Plain memory. On Windows pages that are never written take none either, but all count towards
/// what the system has promised, so that too large a cloud ends in std::bad_alloc there.
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

/// Asks for huge pages behind memory that will be written, where the system offers them and there
/// is more of it than `least` bytes: the first writes then take far fewer page faults, and reads in
/// any order fewer page walks. Memory that is never written still takes no pages, except for the
/// rest of a huge one.
inline void preferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
  [[maybe_unused]] std::size_t least)
{
#ifdef MADV_HUGEPAGE
  if (bytes > least)
  {
    // Whole pages, with the one that holds the allocator's own data: advice for a part of a mapping
    // divides it, and then it could not grow by remapping.
    const std::size_t before = reinterpret_cast<std::uintptr_t>(memory) % pageSize();
    // Advice that is not taken changes nothing.
    static_cast<void>(madvise(static_cast<char*>(memory) - before, before + bytes, MADV_HUGEPAGE));
  }
#endif
}

} // namespace isopoint

#endif
