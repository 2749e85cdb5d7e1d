// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Region.h"
#include "Core/Tree/MedianSelection.h"
#include "Core/Tree/SampleTree.h"
#include "Core/Tree/Separation.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The strict total order on an axis: by this coordinate, the next two cyclically, then id.
template <class TSample>
struct SplittingOrder
{
  explicit SplittingOrder(int axis)
    : First(axis)
    , Second((axis + 1) % 3)
    , Third((axis + 2) % 3)
  {
  }

  bool operator()(const TSample& a, const TSample& b) const
  {
    const auto keyOf = [this](const TSample& sample)
    {
      return std::tuple(sample.position[this->First], sample.position[this->Second],
        sample.position[this->Third], sample.id);
    };
    return keyOf(a) < keyOf(b);
  }

  int First;
  int Second;
  int Third;
};

/// Result of halving a node: the first `lowerCount` samples form the lower child.
struct Halves
{
  std::size_t lowerCount;
  double plane;
};

/// Halves by the definition (docs/algorithm.md, section 3) around coincident middle samples.
/// @returns nothing if all samples share one position
/// Complexity: O(n) on average, O(n log n) at worst
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

/// The first sample of the upper half if the two middle samples share their coordinate on the axis:
/// the other coordinates and the ids then decide.
/// @param forEachCandidate(visit) visits samples, including all with that coordinate
/// @param rank of the result among them
/// @returns nothing if it coincides with the last sample of the lower half
template <class TSample, class ForEach>
std::optional<TSample> firstOfTied(const ForEach& forEachCandidate, std::size_t rank, int axis,
  typename TSample::Coordinate coordinate)
{
  std::vector<TSample> tied;
  forEachCandidate(
    [&](const TSample& candidate)
    {
      rank -= candidate.position[axis] < coordinate ? 1 : 0;
      if (candidate.position[axis] == coordinate)
      {
        tied.push_back(candidate);
      }
    });
  const SplittingOrder<TSample> order(axis);
  const auto middle = tied.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(tied.begin(), middle, tied.end(), order);
  return haveOnePosition(*std::max_element(tied.begin(), middle, order), *middle)
           ? std::nullopt
           : std::optional(*middle);
}

/// Scratch memory of halving.
template <class TSample>
struct HalvingScratch
{
  std::vector<typename TSample::Coordinate> subset;
  std::vector<typename TSample::Coordinate> coordinates;
  AmbiguousSamples<TSample> open;
};

/// Moves samples to their halves, given the middle coordinates.
/// @param forEachCandidate(visit) visits samples, including all that have a middle coordinate
/// @param rank of the first sample of the upper half among them
/// @param partition(belongsLower) moves the samples
/// @returns nothing if all samples share one position
template <class TSample, class ForEach, class Partition>
std::optional<Halves> halveAtMiddle(TSample* samples, std::size_t count, int axis,
  const MiddleCoordinates<typename TSample::Coordinate>& middle, const ForEach& forEachCandidate,
  std::size_t rank, const Partition& partition)
{
  if (middle.last < middle.first)
  {
    partition([axis, first = middle.first](const TSample& s) { return s.position[axis] < first; });
  }
  else
  {
    const auto first = firstOfTied<TSample>(forEachCandidate, rank, axis, middle.first);
    if (!first)
    {
      return halveByDefinition(samples, count, axis);
    }
    // Equal coordinates are rare: the common case takes one comparison.
    partition(
      [axis, first = *first, coordinate = middle.first, order = SplittingOrder<TSample>(axis)](
        const TSample& sample)
      {
        const auto own = sample.position[axis];
        return own == coordinate ? order(sample, first) : own < coordinate;
      });
  }
  return Halves{ count / 2, splittingPlaneBetween(middle.last, middle.first) };
}

/// Halves few samples, or after a bracket missed the middle: finds it, then moves the samples.
template <class TSample>
std::optional<Halves> halveWithoutBracket(
  TSample* samples, std::size_t count, int axis, HalvingScratch<TSample>& scratch)
{
  scratch.coordinates.resize(std::max(scratch.coordinates.size(), count));
  std::transform(samples, samples + count, scratch.coordinates.begin(),
    [axis](const TSample& sample) { return sample.position[axis]; });
  const auto middle = selectMiddle(scratch.coordinates, count, count / 2);
  return halveAtMiddle(
    samples, count, axis, middle,
    [&](const auto& visit) { std::for_each(samples, samples + count, visit); }, count / 2,
    [&](const auto& belongsLower) { exchangeMisplaced(samples, count, count / 2, belongsLower); });
}

/// Swaps open samples that are in the wrong half.
template <class TSample, class Predicate>
void exchangeAmbiguous(AmbiguousSamples<TSample>& open, const Predicate& belongsLower)
{
  const auto keepMisplaced = [](SampleList<TSample>& list, const auto& isMisplaced)
  {
    TSample** next = list.begin();
    for (TSample* const sample : list)
    {
      *next = sample;
      next += isMisplaced(*sample) ? 1 : 0;
    }
    list.resize(static_cast<std::size_t>(next - list.begin()));
  };
  keepMisplaced(open.lower, [&](const TSample& sample) { return !belongsLower(sample); });
  keepMisplaced(open.upper, belongsLower);
  std::size_t i = 0;
  for (TSample* const sample : open.lower)
  {
    std::swap(*sample, *open.upper.begin()[i++]);
  }
}

/// Halves samples after their separation around a bracket.
/// @param halves set to nothing if all samples share one position
/// @returns whether the bracket encloses the middle; if not, samples are only moved
template <class TSample>
bool halveSeparated(TSample* samples, std::size_t count, int axis,
  const MiddleBracket<TSample>& bracket, HalvingScratch<TSample>& scratch,
  std::optional<Halves>& halves)
{
  AmbiguousSamples<TSample>& open = scratch.open;
  const std::size_t rank = open.lower.size();
  const std::size_t openCount = rank + open.upper.size();
  if (rank == 0 || rank == openCount)
  {
    return false;
  }
  scratch.coordinates.resize(std::max(scratch.coordinates.size(), openCount));
  const auto coordinateOf = [axis](const TSample* sample) { return sample->position[axis]; };
  const auto next =
    std::transform(open.lower.begin(), open.lower.end(), scratch.coordinates.begin(), coordinateOf);
  std::transform(open.upper.begin(), open.upper.end(), next, coordinateOf);
  const auto middle = selectMiddle(scratch.coordinates, openCount, rank);
  if (middle.last < bracket.lower || bracket.upper < middle.first)
  {
    return false;
  }
  const auto forEachOpen = [&open](const auto& visit)
  {
    std::for_each(open.lower.begin(), open.lower.end(), [&](const TSample* s) { visit(*s); });
    std::for_each(open.upper.begin(), open.upper.end(), [&](const TSample* s) { visit(*s); });
  };
  halves = halveAtMiddle(samples, count, axis, middle, forEachOpen, rank,
    [&open](const auto& belongsLower) { exchangeAmbiguous(open, belongsLower); });
  return true;
}

/// Halves the samples of a node along an axis, in place: separates them around a bracket of the
/// middle, then finds the middle among the few samples inside.
/// @param separateAround(bracket) separates them and fills scratch.open
/// @returns nothing if all samples share one position
template <class TSample, class Separate>
std::optional<Halves> halveBySeparation(TSample* samples, std::size_t count, int axis,
  HalvingScratch<TSample>& scratch, const Separate& separateAround)
{
  constexpr std::size_t fewSamples = 1024;
  if (count > fewSamples)
  {
    const MiddleBracket<TSample> bracket(samples, count, axis, scratch.subset);
    separateAround(bracket);
    std::optional<Halves> halves;
    if (halveSeparated(samples, count, axis, bracket, scratch, halves))
    {
      return halves;
    }
  }
  return halveWithoutBracket(samples, count, axis, scratch);
}

/// Halves the samples of a node along an axis, in place.
/// @returns nothing if all samples share one position
template <class TSample>
std::optional<Halves> halve(
  TSample* samples, std::size_t count, int axis, HalvingScratch<TSample>& scratch)
{
  return halveBySeparation(samples, count, axis, scratch,
    [&](const auto& bracket) { separate(samples, count, axis, bracket, scratch.open); });
}

/// Halves the samples of a node along an axis, with all threads. @returns as halve()
template <class TSample>
std::optional<Halves> halveTogether(
  const Execution& execution, TSample* samples, std::size_t count, int axis)
{
  HalvingScratch<TSample> scratch;
  return halveBySeparation(samples, count, axis, scratch,
    [&](const auto& bracket)
    { separateTogether(execution, samples, count, axis, bracket, scratch.open); });
}

} // namespace isopoint
