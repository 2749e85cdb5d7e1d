// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_HugePages_h
#define isopoint_HugePages_h

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace isopoint
{

/// Asks for huge pages behind freshly allocated memory, where the system offers them and there is
/// so much of it that it was mapped for this allocation alone: the first writes then take far fewer
/// page faults, and reads in any order fewer page walks. Memory that is never written still takes
/// no pages, but for the rest of a huge one.
inline void preferHugePages(void* memory, std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  // From this size on, glibc maps each allocation by itself, whatever its settings.
  constexpr std::size_t alwaysMapped = std::size_t{ 1 } << 25;
  if (bytes > alwaysMapped)
  {
    // Whole pages, with the one that holds the allocator's own data: advice for a part of a mapping
    // divides it, and then it could not grow by remapping.
    constexpr std::uintptr_t pageSize = 4096;
    const std::size_t before = reinterpret_cast<std::uintptr_t>(memory) % pageSize;
    // Advice that is not taken changes nothing.
    static_cast<void>(madvise(static_cast<char*>(memory) - before, before + bytes, MADV_HUGEPAGE));
  }
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

} // namespace isopoint

#endif
