// SPDX-License-Identifier: GPL-3.0-or-later
// Lists that threads make together, and selection, against their definitions.
#include "Clouds.h"

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Base/Lists.h"
#include "Core/Fit/Selection.h"
#include "Core/Neighbors/NeighborhoodCache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace
{

using Numbers = std::vector<std::size_t>;

Numbers asVector(const isopoint::IndexSpan<std::size_t>& list)
{
  return { list.begin(), list.end() };
}

} // namespace

TEST(ItemLists, ListItemsAtTheirPlacesAscending)
{
  constexpr std::size_t placeCount = 100;
  clouds::Random random(1);
  std::vector<std::array<std::uint32_t, 2>> places; // the last one has no items
  for (std::size_t i = 0; i < 1000; ++i)
  {
    const auto first = static_cast<std::uint32_t>((placeCount - 2) * random());
    places.push_back({ first, first + 1 });
  }
  std::vector<Numbers> expected(placeCount);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    for (const std::size_t place : places[i])
    {
      expected[place].push_back(i);
    }
  }
  isopoint::ItemLists lists(
    {}, placeCount, places.size(), [&places](std::size_t item) { return places[item]; });
  Numbers all;
  for (std::size_t place = 0; place < placeCount; ++place)
  {
    EXPECT_EQ(asVector(lists.at(place)), expected[place]);
    all.insert(all.end(), expected[place].begin(), expected[place].end());
  }
  EXPECT_EQ(std::move(lists).all(), all);
}

TEST(ItemLists, OfNothingAreEmpty)
{
  const isopoint::ItemLists lists({}, 3, 0, [](std::size_t item) { return Numbers{ item }; });
  EXPECT_EQ(lists.at(2).count, 0u);
}

TEST(Collected, IsWhatAllRangesFindInTheirOrder)
{
  for (const std::size_t count : { 0, 1, 10, 1000 })
  {
    const auto even = [](std::size_t begin, std::size_t end, Numbers& found)
    {
      for (std::size_t i = begin + begin % 2; i < end; i += 2)
      {
        found.push_back(i);
      }
    };
    Numbers expected;
    even(0, count, expected);
    EXPECT_EQ(
      isopoint::collected<std::size_t>(clouds::executionOn(3), { count, 40, 10 }, even), expected);
    EXPECT_EQ(isopoint::itemsThat(
                clouds::executionOn(3), count, [](std::size_t item) { return item % 2 == 0; }),
      expected);
  }
}

TEST(Collected, JoinsListsInTheirOrder)
{
  const auto joined = [](const std::vector<std::vector<int>>& lists)
  { return isopoint::joined(clouds::executionOn(2), lists, isopoint::offsetsOf(lists)); };
  EXPECT_EQ(joined({}), std::vector<int>());
  EXPECT_EQ(joined({ { 3, 1 }, {}, { 2 } }), (std::vector<int>{ 3, 1, 2 }));
}

TEST(NeighborhoodCache, KnowsWhatWasAdded)
{
  isopoint::NeighborhoodCache<std::uint32_t> cache;
  EXPECT_TRUE(cache.at(0).isEmpty());
  EXPECT_EQ(cache.room(100), 100u);
  cache.add(clouds::executionOn(2), { { 4, 2, 7, 9, 0, 1, 4 }, {}, { 7, 1, 4 } }, 10);
  cache.add({}, { { 12, 3, 1, 2, 3 } }, 20);
  const auto neighborsOf = [&cache](std::size_t node)
  { return std::vector<std::uint32_t>(cache.at(node).begin(), cache.at(node).end()); };
  using Nodes = std::vector<std::uint32_t>;
  EXPECT_EQ(neighborsOf(4), (Nodes{ 7, 9 }));
  EXPECT_EQ(neighborsOf(0), (Nodes{ 4 }));
  EXPECT_EQ(neighborsOf(7), (Nodes{ 4 }));
  EXPECT_EQ(neighborsOf(12), (Nodes{ 1, 2, 3 }));
  for (const std::size_t unknown : { 1, 9, 13, 19, 20, 1000 })
  {
    EXPECT_TRUE(cache.at(unknown).isEmpty());
  }
  EXPECT_EQ(cache.room(20), 5u);
  EXPECT_EQ(cache.room(10), 0u);
}

TEST(Selection, IsThatOfSorting)
{
  for (const std::size_t count : { 1, 2, 7, 8, 9, 10, 16, 17, 64, 108, 257, 1000 })
  {
    for (const double distinct : { 1.0, 2.0, 5.0, 1e3, 1e15 }) // different numbers, about
    {
      clouds::Random random(count);
      std::vector<double> numbers(count);
      std::generate(
        numbers.begin(), numbers.end(), [&]() { return std::floor(distinct * random()) - 3.0; });
      std::vector<double> sorted = numbers;
      std::sort(sorted.begin(), sorted.end());
      const std::vector<double> descending(sorted.rbegin(), sorted.rend());
      for (std::size_t place = 0; place < count; place += 1 + count / 17)
      {
        for (std::vector<double> reordered : { numbers, sorted, descending })
        {
          EXPECT_EQ(sorted[place], isopoint::selectNth(reordered.data(), count, place));
          std::sort(reordered.begin(), reordered.end());
          EXPECT_EQ(sorted, reordered);
        }
      }
    }
  }
}

TEST(Selection, EndsWithNumbersThatAreNone)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> infinite(50, infinity);
  EXPECT_EQ(infinity, isopoint::selectNth(infinite.data(), infinite.size(), 25));
  std::vector<double> numbers(50, none);
  EXPECT_TRUE(std::isnan(isopoint::selectNth(numbers.data(), numbers.size(), 25)));
}

/// At the borders of blocks and rows, from several threads.
TEST(ConcurrentMemo, KeepsTheFirstValueOfEachIndex)
{
  isopoint::ConcurrentMemo<std::size_t> memo;
  EXPECT_THROW(
    memo.at(5, []() -> std::size_t { throw std::runtime_error("fails"); }), std::runtime_error);
  const Numbers indices{ 0, 5, 15, 16, 16383, 16384, 81919, 81920, 1000000 };
  std::atomic<std::size_t> wrong{ 0 };
  isopoint::forEachIndex(clouds::executionOn(3), 100000,
    [&](std::size_t i)
    {
      const std::size_t index = indices[i % indices.size()];
      wrong += memo.at(index, [index]() { return 3 * index; }) != 3 * index ? 1 : 0;
    });
  EXPECT_EQ(wrong, 0u);
  for (const std::size_t index : indices)
  {
    EXPECT_EQ(memo.at(index, []() -> std::size_t { return 1; }), 3 * index);
  }
}
