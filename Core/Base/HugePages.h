// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_HugePages_h
#define isopoint_HugePages_h

#include <cstddef>
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>

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
