// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Failure.h"
#include "Library/isopoint.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>

namespace isopoint
{

/// Whether the core's enumerators have the same numbers as those in C, so that a cast converts
/// them.
template <class Core, class C>
constexpr bool haveSameNumbers(std::initializer_list<Core> core, std::initializer_list<C> c)
{
  bool areSame = core.size() == c.size();
  for (std::size_t i = 0; areSame && i < core.size(); ++i)
  {
    areSame = static_cast<int>(core.begin()[i]) == static_cast<int>(c.begin()[i]);
  }
  return areSame;
}

/// Takes over options of a program that was compiled against any version 1.x: members that it does
/// not know keep their values, and members that this version does not know have to be 0. Options
/// end without padding: programs may leave it unset, and later versions could put members there.
/// @param sizeOf1_0 the size of the options in version 1.0, whose members every program knows
/// @param initialize the function that sets them up, for messages
/// @param options in: the defaults of this version
/// @throws UsageError
template <class Options>
void takeOptions(
  const Options& given, std::size_t sizeOf1_0, const char* initialize, Options& options)
{
  constexpr std::size_t most = 4096; // more is memory that was never set
  const std::uint64_t size = given.size;
  if (size < sizeOf1_0 || size > most || size % alignof(Options) != 0)
  {
    throw UsageError(
      "The size of the options is " + std::to_string(size) + ". Set them up by " + initialize + ".",
      UsageError::Option);
  }
  const std::size_t known = std::min(static_cast<std::size_t>(size), sizeof(Options));
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&given);
  if (std::any_of(bytes + known, bytes + size, [](unsigned char byte) { return byte != 0; }))
  {
    throw UsageError("An option is set that version " ISOPOINT_VERSION " of the library does not"
                     " know. Leave it at 0, or use the version that introduced it.",
      UsageError::Option);
  }
  std::memcpy(static_cast<void*>(&options), &given, known);
}

/// Sets up options of a program that was compiled against any version 1.x: members that this
/// version does not know are 0.
/// @param options may be null
/// @param size in bytes
template <class Options>
void giveOptions(const Options& defaults, Options* options, std::size_t size)
{
  if (options)
  {
    std::memset(static_cast<void*>(options), 0, size);
    std::memcpy(static_cast<void*>(options), &defaults, std::min(size, sizeof(Options)));
  }
}

} // namespace isopoint
