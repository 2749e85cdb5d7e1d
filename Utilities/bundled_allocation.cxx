// SPDX-License-Identifier: GPL-3.0-or-later
// Memory for a library that brings oneTBB and its C++ library along: Utilities/wheel_elsewhere.sh.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

// In place of oneTBB's own allocator, which CGAL's cells use.

extern "C" void* scalable_malloc(std::size_t bytes)
{
  return std::malloc(bytes);
}

extern "C" void scalable_free(void* memory)
{
  std::free(memory);
}

extern "C" int scalable_allocation_command(int, void*)
{
  return 0;
}

#ifdef __APPLE__

// The library exports the operators of its C++ library. These are compiled hidden, by the option
// -fvisibility-global-new-delete=force-hidden.

void* operator new(std::size_t bytes)
{
  void* const memory = std::malloc(std::max<std::size_t>(bytes, 1));
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return std::malloc(std::max<std::size_t>(bytes, 1));
}

void* operator new[](std::size_t bytes)
{
  return operator new(bytes);
}

void* operator new(std::size_t bytes, std::align_val_t alignment)
{
  void* memory = nullptr;
  if (posix_memalign(&memory, std::max(static_cast<std::size_t>(alignment), sizeof(void*)),
        std::max<std::size_t>(bytes, 1)) != 0)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void* operator new[](std::size_t bytes, std::align_val_t alignment)
{
  return operator new(bytes, alignment);
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

#endif
