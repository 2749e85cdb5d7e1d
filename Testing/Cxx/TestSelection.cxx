// SPDX-License-Identifier: GPL-3.0-or-later
// numberOfRank() against sorting.
#include "Random.h"

#include "Core/Base/Selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace
{

/// @param distinct how many different numbers there are, about
void expectSorted(std::size_t count, double distinct, std::uint64_t seed)
{
  clouds::Random random(seed);
  std::vector<double> numbers(count);
  std::generate(
    numbers.begin(), numbers.end(), [&]() { return std::floor(distinct * random()) - 3.0; });
  std::vector<double> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t place = 0; place < count; place += 1 + count / 17)
  {
    std::vector<double> reordered = numbers;
    EXPECT_EQ(sorted[place], isopoint::numberOfRank(reordered.data(), count, place));
    std::sort(reordered.begin(), reordered.end());
    EXPECT_EQ(sorted, reordered);
  }
}

} // namespace

TEST(Selection, IsThatOfSorting)
{
  for (const std::size_t count : { 1, 2, 7, 8, 9, 10, 16, 17, 64, 108, 257, 1000 })
  {
    for (const double distinct : { 1.0, 2.0, 5.0, 1e3, 1e15 })
    {
      expectSorted(count, distinct, count);
    }
  }
}

TEST(Selection, TakesOrderedNumbers)
{
  std::vector<double> ascending(100);
  for (std::size_t i = 0; i < ascending.size(); ++i)
  {
    ascending[i] = static_cast<double>(i);
  }
  std::vector<double> descending(ascending.rbegin(), ascending.rend());
  EXPECT_EQ(50.0, isopoint::numberOfRank(ascending.data(), 100, 50));
  EXPECT_EQ(50.0, isopoint::numberOfRank(descending.data(), 100, 50));
}

TEST(Selection, EndsWithNumbersThatAreNone)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> infinite(50, infinity);
  EXPECT_EQ(infinity, isopoint::numberOfRank(infinite.data(), infinite.size(), 25));
  std::vector<double> numbers(50, none);
  EXPECT_TRUE(std::isnan(isopoint::numberOfRank(numbers.data(), numbers.size(), 25)));
}
