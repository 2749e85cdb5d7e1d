// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library/VersionedOptions.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace
{

struct First
{
  std::uint64_t size;
  double number;
};

struct Later
{
  std::uint64_t size;
  double number;
  std::int32_t added;
  std::int32_t latest;
};

constexpr Later defaults{ sizeof(Later), 1.5, 7, 8 };

/// What the library takes of the first `size` bytes of options.
Later taken(std::size_t size, const Later& given)
{
  std::array<std::uint64_t, 16> memory;
  memory.fill(~std::uint64_t{ 0 });
  std::memcpy(memory.data(), &given, std::min(size, sizeof(Later)));
  memory[0] = size;
  Later options = defaults;
  isopoint::takeOptions(
    *reinterpret_cast<const Later*>(memory.data()), sizeof(First), "initialize()", options);
  return options;
}

} // namespace

TEST(VersionedOptions, ProgramsOfEarlierVersionsGetTheDefaultsOfLaterOptions)
{
  const Later options = taken(sizeof(First), { 0, 2.5, -1, -1 });
  EXPECT_EQ(options.number, 2.5);
  EXPECT_EQ(options.added, 7);
  EXPECT_EQ(options.latest, 8);
  EXPECT_EQ(taken(sizeof(Later), { 0, 2.5, -1, -2 }).latest, -2);
}

TEST(VersionedOptions, SizesThatNoVersionHasAreRefused)
{
  for (const std::size_t size : { std::size_t{ 0 }, sizeof(First) - 8, sizeof(First) + 4,
         std::size_t{ 1 } << 40, ~std::size_t{ 0 } })
  {
    EXPECT_THROW(taken(size, defaults), isopoint::UsageError) << size;
  }
}

TEST(VersionedOptions, OptionsOfLaterVersionsHaveToBeZero)
{
  EXPECT_THROW(taken(sizeof(Later) + 8, defaults), isopoint::UsageError);
}

TEST(VersionedOptions, NoMoreIsWrittenThanTheProgramHas)
{
  std::array<std::uint64_t, 4> memory;
  memory.fill(~std::uint64_t{ 0 });
  isopoint::giveOptions(defaults, reinterpret_cast<Later*>(memory.data()), sizeof(First));
  EXPECT_EQ(memory[2], ~std::uint64_t{ 0 });
  isopoint::giveOptions(defaults, reinterpret_cast<Later*>(memory.data()), sizeof(memory));
  EXPECT_EQ(memory[3], 0u);
  isopoint::giveOptions<Later>(defaults, nullptr, 0);
}
