// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// Makes chosen allocations of the whole program fail. It replaces malloc, realloc and calloc of
/// the C library; under the address sanitizer, which replaces these itself, operator new and
/// realloc (by the linker's --wrap).
namespace failingallocator
{

/// In bytes. Allocations whose size depends on the number of samples are at least this large.
constexpr std::size_t largeSize = std::size_t{ 1 } << 12;

/// From now on the n-th allocation (from 1) of at least `smallest` bytes fails and, if
/// `andAllLater`, so do all later ones.
void failAt(long n, bool andAllLater, std::size_t smallest = largeSize);

/// Ends the failures. @returns the number of such allocations since failAt()
long stop();

} // namespace failingallocator
