// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Splitting_h
#define isopoint_Splitting_h

#include "Execution.h"
#include "Partition.h"
#include "Region.h"
#include "Sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

namespace isopoint
{

/// How a node's samples were halved: the first `lowerCount` of them now form the lower child, and
/// the region is cut at `plane`. A lowerCount of 0 says that all samples share one position.
struct Halves
{
  std::size_t lowerCount;
  double plane;
};

/// Halves by the definition, with the standard library's selection: for small nodes, and wherever
/// a position stands on both sides of the middle. Linear time on average, O(n log n) at worst.
template <class TSample>
Halves halveByDefinition(TSample* samples, std::size_t count, int axis)
{
  const SplittingOrder<TSample> order(axis);
  TSample* const end = samples + count;
  TSample* middle = samples + count / 2;
  std::nth_element(samples, middle, end, order);
  const TSample* last = std::max_element(samples, middle, order);
  if (haveOnePosition(*last, *middle))
  {
    const TSample shared = *middle;
    const auto isShared = [&shared](const TSample& s) { return haveOnePosition(s, shared); };
    middle = std::partition(middle, end, isShared);
    if (middle == end)
    {
      middle = std::partition(
        samples, samples + count / 2, [&](const TSample& s) { return !isShared(s); });
      if (middle == samples)
      {
        return { 0, 0.0 };
      }
    }
    last = std::max_element(samples, middle, order);
  }
  const TSample* first = std::min_element(middle, end, order);
  return { static_cast<std::size_t>(middle - samples),
    splittingPlaneBetween(last->position[axis], first->position[axis]) };
}

/// Bounds that very likely enclose the coordinates of the two samples in the middle, few others,
/// read off a sorted random subset (Floyd and Rivest, "Expected time bounds for selection", 1975).
/// The generator is seeded by the count, so that a run can be repeated to the last move.
template <class TSample>
struct MiddleBracket
{
  using Coordinate = typename TSample::Coordinate;
  Coordinate lower = -std::numeric_limits<Coordinate>::infinity();
  Coordinate upper = std::numeric_limits<Coordinate>::infinity();
  std::size_t expectedCount = 0;

  MiddleBracket(
    const TSample* samples, std::size_t count, int axis, std::vector<Coordinate>& subset)
  {
    const double root = std::cbrt(static_cast<double>(count));
    const std::size_t size = std::min<std::size_t>(static_cast<std::size_t>(root * root), 32768);
    subset.resize(size);
    std::uint64_t state = count;
    for (Coordinate& coordinate : subset)
    {
      state = state * 6364136223846793005u + 1442695040888963407u;
      coordinate = samples[(state >> 16) % count].position[axis];
    }
    // The middle's rank in the subset has a standard deviation of sqrt(size) / 2.
    const auto margin = static_cast<std::size_t>(1.75 * std::sqrt(static_cast<double>(size))) + 1;
    const std::size_t middle = size / 2;
    const auto begin = subset.begin();
    if (margin < middle && middle + margin < size)
    {
      const auto low = begin + static_cast<std::ptrdiff_t>(middle - margin);
      const auto high = begin + static_cast<std::ptrdiff_t>(middle + margin);
      std::nth_element(begin, low, subset.end());
      this->lower = *low;
      std::nth_element(low, high, subset.end());
      this->upper = *high;
    }
    this->expectedCount = count / size * (2 * margin + 2);
  }
};

/// What a search for the middle needs besides the samples, kept to spare allocations.
template <class TSample>
struct SplittingScratch
{
  std::vector<typename TSample::Coordinate> subset;
  std::vector<TSample> candidates;
};

/// What one pass over samples found of the middle.
struct MiddleCount
{
  std::size_t below = 0;      // samples below the bracket
  std::size_t candidates = 0; // samples in it
  bool complete = true;       // no more candidates than allowed
};

/// Counts the samples below the bracket and lists those inside it, at most `limit` of them, at the
/// beginning of `candidates`, which only grows.
template <class TSample>
MiddleCount collectMiddle(const TSample* samples, std::size_t count, int axis,
  const MiddleBracket<TSample>& bracket, std::size_t limit, std::vector<TSample>& candidates)
{
  constexpr std::size_t blockSize = 256;
  const auto lower = bracket.lower;
  const auto upper = bracket.upper;
  MiddleCount result;
  for (std::size_t block = 0; block < count; block += blockSize)
  {
    if (result.candidates > limit)
    {
      result.complete = false;
      break;
    }
    if (candidates.size() < result.candidates + blockSize)
    {
      candidates.resize(2 * result.candidates + blockSize);
    }
    TSample* const listed = candidates.data();
    std::size_t below = 0;
    std::size_t found = result.candidates;
    const std::size_t end = std::min(block + blockSize, count);
    for (std::size_t i = block; i < end; ++i)
    {
      const auto coordinate = samples[i].position[axis];
      listed[found] = samples[i];
      found += (coordinate >= lower) & (coordinate <= upper) ? 1 : 0;
      below += coordinate < lower ? 1 : 0;
    }
    result.candidates = found;
    result.below += below;
  }
  return result;
}

/// The first sample of the upper half and the plane, where the candidates from the bracket settle
/// it; the order of the candidates changes.
template <class TSample>
struct Middle
{
  bool found = false;
  TSample first{};
  double plane = 0.0;

  Middle(std::size_t count, int axis, const MiddleCount& counted, TSample* candidates)
  {
    const std::size_t rank = count / 2;
    if (!counted.complete || counted.below >= rank || counted.below + counted.candidates <= rank)
    {
      return;
    }
    const SplittingOrder<TSample> order(axis);
    TSample* const middle = candidates + (rank - counted.below);
    std::nth_element(candidates, middle, candidates + counted.candidates, order);
    const TSample& last = *std::max_element(candidates, middle, order);
    this->found = !haveOnePosition(last, *middle);
    this->first = *middle;
    this->plane = splittingPlaneBetween(last.position[axis], middle->position[axis]);
  }
};

/// Whether a sample comes before the first one of the upper half. Equal coordinates are the
/// exception, so that the common case is a single comparison.
template <class TSample>
struct BelongsLower
{
  explicit BelongsLower(const TSample& first, int axis)
    : First(first)
    , Coordinate(first.position[axis])
    , Axis(axis)
    , Order(axis)
  {
  }

  bool operator()(const TSample& sample) const
  {
    const auto coordinate = sample.position[this->Axis];
    if (coordinate == this->Coordinate)
    {
      return this->Order(sample, this->First);
    }
    return coordinate < this->Coordinate;
  }

  TSample First;
  typename TSample::Coordinate Coordinate;
  int Axis;
  SplittingOrder<TSample> Order;
};

/// Halves the samples of one node along an axis, in place: one pass that finds the middle and one
/// that moves each misplaced sample once. Both are free of unpredictable branches.
template <class TSample>
Halves halve(TSample* samples, std::size_t count, int axis, SplittingScratch<TSample>& scratch)
{
  constexpr std::size_t smallCount = 384;
  if (count >= smallCount)
  {
    const MiddleBracket<TSample> bracket(samples, count, axis, scratch.subset);
    const MiddleCount counted = collectMiddle(
      samples, count, axis, bracket, 2 * bracket.expectedCount + 256, scratch.candidates);
    const Middle<TSample> middle(count, axis, counted, scratch.candidates.data());
    if (middle.found)
    {
      const std::size_t lowerCount = count / 2;
      exchangeMisplaced(samples, lowerCount, samples + lowerCount, count - lowerCount,
        BelongsLower<TSample>(middle.first, axis));
      return { lowerCount, middle.plane };
    }
  }
  return halveByDefinition(samples, count, axis);
}

/// The same with every thread at work on one node.
template <class TSample>
Halves halveTogether(const Execution& execution, TSample* samples, std::size_t count, int axis)
{
  SplittingScratch<TSample> scratch;
  const MiddleBracket<TSample> bracket(samples, count, axis, scratch.subset);
  const std::size_t limit = 2 * bracket.expectedCount + 256;
  std::mutex mutex;
  MiddleCount total;
  forRanges(execution, count, count / (4 * execution.threads) + 1,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<TSample> candidates;
      const MiddleCount counted =
        collectMiddle(samples + begin, end - begin, axis, bracket, limit, candidates);
      const std::lock_guard<std::mutex> lock(mutex);
      total.complete = total.complete && counted.complete;
      if (total.complete)
      {
        total.below += counted.below;
        total.candidates += counted.candidates;
        scratch.candidates.insert(scratch.candidates.end(), candidates.begin(),
          candidates.begin() + static_cast<std::ptrdiff_t>(counted.candidates));
      }
    });
  throwIfAborted(execution);
  const Middle<TSample> middle(count, axis, total, scratch.candidates.data());
  if (middle.found)
  {
    const std::size_t lowerCount = count / 2;
    partitionTogether(
      execution, samples, count, lowerCount, BelongsLower<TSample>(middle.first, axis));
    return { lowerCount, middle.plane };
  }
  return halveByDefinition(samples, count, axis);
}

} // namespace isopoint

#endif
