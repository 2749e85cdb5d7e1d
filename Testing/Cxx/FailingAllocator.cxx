// SPDX-License-Identifier: GPL-3.0-or-later
#include "FailingAllocator.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace
{

std::atomic<bool> isArmed{ false };
std::atomic<long> seen{ 0 };
std::atomic<long> failingFrom{ 0 };
std::atomic<long> failingTo{ 0 };
std::atomic<std::size_t> smallestFailing{ 0 };

bool fails(std::size_t size)
{
  if (!isArmed || size < smallestFailing)
  {
    return false;
  }
  const long number = ++seen;
  const bool isFailure = number >= failingFrom && number <= failingTo;
  errno = isFailure ? ENOMEM : errno;
  return isFailure;
}

} // namespace

namespace failingallocator
{

void failAt(long n, bool andAllLater, std::size_t smallest)
{
  smallestFailing = smallest;
  seen = 0;
  failingFrom = n;
  failingTo = andAllLater ? 1000000000 : n;
  isArmed = true;
}

long stop()
{
  isArmed = false;
  return seen;
}

} // namespace failingallocator

#ifdef __SANITIZE_ADDRESS__

extern "C" void* __real_realloc(void* memory, std::size_t size);
extern "C" void* __wrap_realloc(void* memory, std::size_t size)
{
  return fails(size) ? nullptr : __real_realloc(memory, size);
}

void* operator new(std::size_t size)
{
  void* const memory = fails(size) ? nullptr : std::malloc(size);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return fails(size) ? nullptr : std::malloc(size);
}

void operator delete(void* memory) noexcept
{
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

#else

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);

extern "C" void* malloc(std::size_t size)
{
  return fails(size) ? nullptr : __libc_malloc(size);
}

extern "C" void* realloc(void* memory, std::size_t size)
{
  return fails(size) ? nullptr : __libc_realloc(memory, size);
}

extern "C" void* calloc(std::size_t count, std::size_t size)
{
  return fails(count * size) ? nullptr : __libc_calloc(count, size);
}

#endif
