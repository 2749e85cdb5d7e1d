// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_HugePages_h
#define isopoint_HugePages_h

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace isopoint
{

#ifdef __linux__
/// The size of the system's pages, in bytes.
inline std::uintptr_t pageSize()
{
  return static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
}
#endif

/// Asks for huge pages behind memory that will be written, where the system offers them and there
/// is so much of it that it was mapped for one allocation alone: the first writes then take far
/// fewer page faults, and reads in any order fewer page walks. Memory that is never written still
/// takes no pages, except for the rest of a huge one.
inline void preferHugePages(void* memory, std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  // From this size on, glibc maps each allocation separately, whatever its settings.
  constexpr std::size_t alwaysMapped = std::size_t{ 1 } << 25;
  if (bytes > alwaysMapped)
  {
    // Whole pages, with the one that holds the allocator's own data: advice for a part of a mapping
    // divides it, and then it could not grow by remapping.
    const std::size_t before = reinterpret_cast<std::uintptr_t>(memory) % pageSize();
    // Advice that is not taken changes nothing.
    static_cast<void>(madvise(static_cast<char*>(memory) - before, before + bytes, MADV_HUGEPAGE));
  }
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

/// Addresses for this many bytes, most of which will never be written: only pages that are written
/// take memory, and none is set aside. Where the system knows no such thing, plain memory.
/// @returns null if there are none
inline void* reserveSpread(std::size_t bytes)
{
#ifdef MAP_NORESERVE
  void* const memory = mmap(nullptr, bytes > 0 ? bytes : 1, PROT_READ | PROT_WRITE,
    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
  {
    return nullptr;
  }
#ifdef MADV_NOHUGEPAGE
  static_cast<void>(madvise(memory, bytes, MADV_NOHUGEPAGE));
#endif
  return memory;
#else
  return std::malloc(bytes > 0 ? bytes : 1);
#endif
}

/// Gives back what reserveSpread() reserved.
inline void releaseSpread(void* memory, std::size_t bytes)
{
#ifdef MAP_NORESERVE
  static_cast<void>(munmap(memory, bytes > 0 ? bytes : 1));
#else
  static_cast<void>(bytes);
  std::free(memory);
#endif
}

/// Gives back the memory of the whole pages in a range, whose content is lost; its addresses stay.
inline void discardPages(void* begin, std::size_t bytes)
{
#ifdef MADV_DONTNEED
  const std::uintptr_t page = pageSize();
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t last = (address + bytes) / page * page;
  if (first < last)
  {
    static_cast<void>(
      madvise(static_cast<char*>(begin) + (first - address), last - first, MADV_DONTNEED));
  }
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

} // namespace isopoint

#endif
