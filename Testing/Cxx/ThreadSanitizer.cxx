// SPDX-License-Identifier: GPL-3.0-or-later
// What the thread sanitizer must know of libraries that are not instrumented.
#include <cstddef>
#include <cstdlib>

// oneTBB's allocator hands memory from one thread to another by means that the sanitizer does not
// see, so that each object of CGAL would race with the one that was there before it. These
// functions, which CGAL calls, take their place; the C library's allocator is instrumented.
extern "C"
{
  void* scalable_malloc(std::size_t size)
  {
    return std::malloc(size);
  }

  void scalable_free(void* memory)
  {
    std::free(memory);
  }

  int scalable_allocation_command(int, void*)
  {
    return 0;
  }
}
