// SPDX-License-Identifier: GPL-3.0-or-later
// In place of oneTBB's own allocator, which CGAL's cells use: for Utilities/wheel_elsewhere.sh.
#include <cstddef>
#include <cstdlib>

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
