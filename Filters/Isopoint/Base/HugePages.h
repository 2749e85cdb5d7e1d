// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_HugePages_h
#define isopoint_HugePages_h

#include "Isopoint/Base/Execution.h"

#include <cstddef>
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

namespace isopoint
{

constexpr std::size_t usualHugePage = std::size_t{ 1 } << 21; // bytes

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

/// Makes room for so many elements, on huge pages if there are many. The vector may be filled from
/// then on. @throws std::bad_alloc
template <class T>
void reserveOnHugePages(std::vector<T>& vector, std::size_t count)
{
  constexpr std::size_t few = 2 * usualHugePage;
  if (vector.capacity() < count)
  {
    vector.reserve(count);
    preferHugePages(vector.data(), count * sizeof(T), few);
  }
}

/// Lets all threads take the page faults of the first writes to memory that will be written at
/// once, where the system can: one thread would take them one after the other.
inline void takePages([[maybe_unused]] const Execution& execution, [[maybe_unused]] void* memory,
  [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t page = usualHugePage;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = (page - address % page) % page;
  if (execution.threads > 1 && bytes > before)
  {
    constexpr std::size_t grain = 4;
    char* const first = static_cast<char*>(memory) + before;
    forRanges(execution, (bytes - before) / page, grain,
      [first](std::size_t begin, std::size_t end)
      {
        // Where this fails the writes do what it would have done.
        static_cast<void>(madvise(first + begin * page, (end - begin) * page, MADV_POPULATE_WRITE));
      });
  }
#endif
}

/// Elements without a value of their own, on huge pages if there are many. @throws std::bad_alloc
template <class T>
std::vector<T> onHugePages(const Execution& execution, std::size_t count)
{
  std::vector<T> vector;
  reserveOnHugePages(vector, count);
  takePages(execution, vector.data(), count * sizeof(T));
  vector.resize(count);
  return vector;
}

} // namespace isopoint

#endif
