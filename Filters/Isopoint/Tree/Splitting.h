// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_Splitting_h
#define isopoint_Splitting_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Region.h"
#include "Isopoint/Tree/MedianSelection.h"
#include "Isopoint/Tree/Partition.h"
#include "Isopoint/Tree/Sample.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// How a node's samples were halved: the first `lowerCount` of them now form the lower child, and
/// the region is cut at `plane`.
struct Halves
{
  std::size_t lowerCount;
  double plane;
};

/// Halves by the definition (docs/algorithm.md, section 3), with the standard library's selection,
/// for nodes where coincident samples stand on both sides of the middle.
/// @returns nothing if all samples share one position
/// Complexity: O(n) on average, O(n log n) at worst.
template <class TSample>
std::optional<Halves> halveByDefinition(TSample* samples, std::size_t count, int axis)
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
        return std::nullopt;
      }
    }
    last = std::max_element(samples, middle, order);
  }
  const TSample* first = std::min_element(middle, end, order);
  return Halves{ static_cast<std::size_t>(middle - samples),
    splittingPlaneBetween(last->position[axis], first->position[axis]) };
}

/// Whether a sample precedes the first one of the upper half. Equal coordinates are rare: the
/// common case takes a single comparison.
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

/// The samples in the middle of a node that share their coordinate on the axis, so that the other
/// coordinates and the ids determine the first of the upper half.
template <class TSample>
struct TiedMiddle
{
  TSample first{};
  bool haveOnePosition = false; // the last of the lower half and the first of the upper

  TiedMiddle(
    const TSample* samples, std::size_t count, int axis, typename TSample::Coordinate coordinate)
  {
    std::vector<TSample> tied;
    std::size_t below = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      below += samples[i].position[axis] < coordinate ? 1 : 0;
      if (samples[i].position[axis] == coordinate)
      {
        tied.push_back(samples[i]);
      }
    }
    const SplittingOrder<TSample> order(axis);
    const auto middle = tied.begin() + static_cast<std::ptrdiff_t>(count / 2 - below);
    std::nth_element(tied.begin(), middle, tied.end(), order);
    this->first = *middle;
    this->haveOnePosition =
      isopoint::haveOnePosition(*std::max_element(tied.begin(), middle, order), *middle);
  }
};

/// Moves the samples to their halves, where the middle coordinates are known.
/// @param partition(lowerCount, belongsLower) moves them
/// @returns nothing if all samples share one position
template <class TSample, class Partition>
std::optional<Halves> halveAtMiddle(TSample* samples, std::size_t count, int axis,
  const MiddleCoordinates<typename TSample::Coordinate>& middle, const Partition& partition)
{
  const std::size_t lowerCount = count / 2;
  if (middle.last < middle.first)
  {
    partition(lowerCount, [axis, first = middle.first](const TSample& sample)
      { return sample.position[axis] < first; });
  }
  else
  {
    const TiedMiddle<TSample> tied(samples, count, axis, middle.first);
    if (tied.haveOnePosition)
    {
      return halveByDefinition(samples, count, axis);
    }
    partition(lowerCount, BelongsLower<TSample>(tied.first, axis));
  }
  return Halves{ lowerCount, splittingPlaneBetween(middle.last, middle.first) };
}

/// Halves the samples of one node along an axis, in place: one pass finds the middle and another
/// moves each misplaced sample once.
/// @returns nothing if all samples share one position
template <class TSample>
std::optional<Halves> halve(TSample* samples, std::size_t count, int axis,
  SelectionScratch<typename TSample::Coordinate>& scratch)
{
  return halveAtMiddle(samples, count, axis, findMiddle(samples, count, axis, scratch),
    [&](std::size_t lowerCount, const auto& belongsLower)
    {
      exchangeMisplaced(
        samples, lowerCount, samples + lowerCount, count - lowerCount, belongsLower);
    });
}

/// The same with every thread at work on one node.
template <class TSample>
std::optional<Halves> halveTogether(
  const Execution& execution, TSample* samples, std::size_t count, int axis)
{
  const auto middle = findMiddleTogether(execution, samples, count, axis);
  throwIfAborted(execution);
  return halveAtMiddle(samples, count, axis, middle,
    [&](std::size_t lowerCount, const auto& belongsLower)
    { partitionTogether(execution, samples, count, lowerCount, belongsLower); });
}

} // namespace isopoint

#endif
