// SPDX-License-Identifier: GPL-3.0-or-later
// A library to be preloaded that limits the large allocations of a program, those whose size grows
// with the number of splats. Smaller ones are not limited, since Mesa crashes if one of its own, of
// up to 1.4 MB, fails while it draws.
#include <cstddef>
#include <cstdlib>
#include <mutex>

namespace
{

constexpr std::size_t largeSize = std::size_t{ 3 } << 19;

std::mutex mutex;
bool isLimited = false;
std::size_t left = 0;

struct Allocation
{
  void* Memory = nullptr;
  std::size_t Size = 0;
};
Allocation allocations[1000]; // the large ones since limitMemory()

/// Takes memory from what is left. @returns whether there was enough
bool take(std::size_t size)
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (!isLimited || size < largeSize)
  {
    return true;
  }
  if (size > left)
  {
    return false;
  }
  left -= size;
  return true;
}

void* keep(void* memory, std::size_t size)
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (isLimited && size >= largeSize)
  {
    for (Allocation& allocation : allocations)
    {
      if (!allocation.Memory)
      {
        allocation = { memory, size };
        return memory;
      }
    }
    std::abort();
  }
  return memory;
}

void giveBack(void* memory)
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (!isLimited || !memory)
  {
    return;
  }
  for (Allocation& allocation : allocations)
  {
    if (allocation.Memory == memory)
    {
      left += allocation.Size;
      allocation = {};
    }
  }
}

} // namespace

extern "C"
{
  void* __libc_malloc(std::size_t size);
  void* __libc_realloc(void* memory, std::size_t size);
  void* __libc_calloc(std::size_t count, std::size_t size);
  void* __libc_memalign(std::size_t alignment, std::size_t size);
  void __libc_free(void* memory);

  /// Limits the sum of later large allocations, in bytes, until unlimitMemory().
  void limitMemory(std::size_t bytes)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    isLimited = true;
    left = bytes;
    for (Allocation& allocation : allocations)
    {
      allocation = {};
    }
  }

  void unlimitMemory()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    isLimited = false;
  }

  void* malloc(std::size_t size)
  {
    return take(size) ? keep(__libc_malloc(size), size) : nullptr;
  }

  void* calloc(std::size_t count, std::size_t size)
  {
    return take(count * size) ? keep(__libc_calloc(count, size), count * size) : nullptr;
  }

  void* realloc(void* memory, std::size_t size)
  {
    if (!take(size))
    {
      return nullptr;
    }
    giveBack(memory);
    return keep(__libc_realloc(memory, size), size);
  }

  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    return take(size) ? keep(__libc_memalign(alignment, size), size) : nullptr;
  }

  int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
  {
    constexpr int noMemory = 12;
    *memory = aligned_alloc(alignment, size);
    return *memory ? 0 : noMemory;
  }

  void free(void* memory)
  {
    giveBack(memory);
    __libc_free(memory);
  }
}
