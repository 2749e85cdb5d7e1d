// SPDX-License-Identifier: GPL-3.0-or-later
// The fast halving against the definition, in orders that are hard on selection algorithms.
#include "Clouds.h"

#include "Core/Tree/BinaryIndex.h"
#include "Core/Tree/Splitting.h"

#include <gtest/gtest.h>

namespace
{

using namespace isopoint;

std::vector<FloatSample> samplesOf(
  std::size_t count, const std::function<double(std::size_t, int)>& coordinate)
{
  std::vector<FloatSample> samples(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      samples[i].position[axis] = static_cast<float>(coordinate(i, axis));
    }
    samples[i].id = static_cast<std::uint32_t>(i);
    samples[i].value = static_cast<float>(i);
  }
  return samples;
}

std::vector<std::uint32_t> sortedIds(const FloatSample* begin, const FloatSample* end)
{
  std::vector<std::uint32_t> ids;
  for (const FloatSample* sample = begin; sample != end; ++sample)
  {
    ids.push_back(sample->id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

void expectHalvedByDefinition(const std::vector<FloatSample>& samples)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<FloatSample> expected = samples;
    const std::optional<Halves> byDefinition =
      halveByDefinition(expected.data(), expected.size(), axis);
    ASSERT_TRUE(byDefinition);
    const auto check = [&](std::vector<FloatSample>& found, const std::optional<Halves>& halves)
    {
      ASSERT_TRUE(halves);
      ASSERT_EQ(byDefinition->lowerCount, halves->lowerCount);
      ASSERT_EQ(byDefinition->plane, halves->plane);
      const auto lower = static_cast<std::ptrdiff_t>(halves->lowerCount);
      const FloatSample* const begin = found.data();
      const FloatSample* const end = begin + found.size();
      EXPECT_EQ(
        sortedIds(expected.data(), expected.data() + lower), sortedIds(begin, begin + lower));
      EXPECT_EQ(sortedIds(expected.data() + lower, expected.data() + expected.size()),
        sortedIds(begin + lower, end));
    };
    HalvingScratch<FloatSample> reused;
    std::vector<FloatSample> alone = samples;
    check(alone, halve(alone.data(), alone.size(), axis, reused));
    std::vector<FloatSample> together = samples;
    check(together, halveTogether(clouds::executionOn(3), together.data(), together.size(), axis));
  }
}

} // namespace

TEST(Splitting, AnyOrder)
{
  for (const std::size_t count : { 2, 3, 5, 383, 384, 385, 1000, 4096, 50001 })
  {
    SCOPED_TRACE(count);
    clouds::Random random(count);
    const std::function<double(std::size_t, int)> coordinates[] = {
      [&](std::size_t, int) { return random(); },
      [&](std::size_t i, int axis) { return double(axis == 0 ? i : count - i); },
      [&](std::size_t i, int) { return double(std::min(i, count - i)); },
      [&](std::size_t i, int axis) { return axis == 1 ? double(i) : 1.0; },
      [&](std::size_t, int) { return std::floor(3.0 * random()); },
      [&](std::size_t i, int) { return i % 10 == 0 ? random() : 0.5; },
      [&](std::size_t, int) { return std::pow(10.0, 60.0 * random() - 30.0); },
    };
    for (const auto& coordinate : coordinates)
    {
      expectHalvedByDefinition(samplesOf(count, coordinate));
    }
  }
}

TEST(Splitting, CoincidentSamplesAreNotSplit)
{
  for (const std::size_t count : { 2, 500, 70000 })
  {
    for (const double zero : { 0.0, -0.0 })
    {
      std::vector<FloatSample> samples =
        samplesOf(count, [=](std::size_t i, int) { return i == 0 ? 0.0 : zero; });
      HalvingScratch<FloatSample> reused;
      EXPECT_FALSE(halve(samples.data(), count, 0, reused));
      EXPECT_FALSE(halveByDefinition(samples.data(), count, 0));
    }
  }
}

// A way down from the root and back, by the turns taken.
TEST(BinaryIndex, NamesAWayThroughTheTree)
{
  std::vector<BinaryIndex> way{ rootIndex };
  std::vector<bool> turns;
  for (int depth = 0; depth < maximumDepth; ++depth)
  {
    turns.push_back(depth % 3 == 0 || depth % 7 == 2);
    way.push_back(turns.back() ? upperChild(way.back()) : lowerChild(way.back()));
    EXPECT_EQ(depthOf(way.back()), depth + 1);
    EXPECT_EQ(isUpperChild(way.back()), turns.back());
  }
  for (std::size_t from = 0; from < way.size(); ++from)
  {
    for (std::size_t to = 0; to <= from; ++to)
    {
      EXPECT_TRUE(ancestorOf(way[from], static_cast<int>(from - to)) == way[to]);
      EXPECT_TRUE(from == to || way[from] != way[to]);
    }
  }
}

TEST(BinaryIndex, LevelsThatHalveSamples)
{
  EXPECT_EQ(levelsToHalve(1), 0);
  EXPECT_EQ(levelsToHalve(2), 1);
  EXPECT_EQ(levelsToHalve(3), 2);
  for (int level = 2; level < 60; ++level)
  {
    const std::size_t power = std::size_t{ 1 } << level;
    EXPECT_EQ(levelsToHalve(power - 1), level);
    EXPECT_EQ(levelsToHalve(power), level);
    EXPECT_EQ(levelsToHalve(power + 1), level + 1);
  }
}
