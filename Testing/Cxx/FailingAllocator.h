// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FailingAllocator_h
#define FailingAllocator_h

#include <cstddef>

/// Allocations of the whole program can be made to fail, one by one. Takes the place of the C
/// library's malloc and its kin; with the address sanitizer, which does so itself, of operator new
/// and of realloc (by the linker's --wrap).
namespace failingallocator
{

/// Of allocations, those of at least so many bytes grow with the number of samples.
constexpr std::size_t largeSize = std::size_t{ 1 } << 12;

/// From now on the n-th allocation of at least so many bytes fails (from 1), and all later ones as
/// well if so wanted.
void failAt(long n, bool andAllLater, std::size_t smallest = largeSize);

/// No more failures. @returns how many such allocations there were since failAt()
long stop();

} // namespace failingallocator

#endif
