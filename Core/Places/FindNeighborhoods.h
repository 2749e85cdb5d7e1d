// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Places/Neighborhoods.h"
#include "Core/Places/ProbePlaces.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace isopoint
{

/// Numbers a few of many tree indices, ascending from 0.
class TreeIndexNumbers
{
public:
  explicit TreeIndexNumbers(std::size_t count)
    : Words(count / wordSize + 1, 0)
    , Before(this->Words.size(), 0)
  {
  }

  void add(std::size_t treeIndex) { this->Words[treeIndex / wordSize] |= bitOf(treeIndex); }

  /// After all are added. @returns how many there are
  std::size_t finish()
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < this->Words.size(); ++i)
    {
      this->Before[i] = count;
      count += std::bitset<wordSize>(this->Words[i]).count();
    }
    return count;
  }

  std::size_t at(std::size_t treeIndex) const
  {
    const std::uint64_t lower = this->Words[treeIndex / wordSize] & (bitOf(treeIndex) - 1);
    return this->Before[treeIndex / wordSize] + std::bitset<wordSize>(lower).count();
  }

private:
  static constexpr std::size_t wordSize = 64;
  static std::uint64_t bitOf(std::size_t treeIndex)
  {
    return std::uint64_t{ 1 } << treeIndex % wordSize;
  }

  std::vector<std::uint64_t> Words;
  std::vector<std::size_t> Before; // number of indices in former words
};

/// See IsosurfaceExtractor::findNeighborhoods().
template <class TSample, class TNodes>
Neighborhoods neighborhoodsOf(const Execution& execution, const SampleTree<TSample>& tree,
  TNodes& nodes, const std::vector<Vector>& places, const ProbeOptions& options)
{
  struct Found
  {
    std::size_t begin; // tree index
    std::size_t count; // of coincident samples

    bool operator<(const Found& other) const { return this->begin < other.begin; }
    bool operator==(const Found& other) const { return this->begin == other.begin; }
  };
  const bool isLinear = options.method != PlaceMethod::Blend;
  const std::size_t needed = neededCount(options);
  const std::vector<ProbedArray> none;
  Neighborhoods result;
  result.options = options;
  result.places = places;
  result.kinds.resize(places.size());
  result.reaches.resize(places.size());
  std::vector<std::size_t> counts(places.size());
  std::vector<std::size_t> found(needed * places.size()); // tree indices
  std::vector<double> weights(isLinear ? laneCount * found.size() : 0);
  std::vector<Found> coincident;
  std::mutex mutex;
  forSurroundings(
    execution, tree, nodes, options, places, [&]() { return PlaceEvaluator(options, none); },
    [&](PlaceEvaluator& evaluator, std::size_t place, const SurroundingsSearch<TSample>& search)
    {
      const NearbySamples& around = search.around();
      result.kinds[place] = evaluator.enter(around);
      result.reaches[place] = around.reach;
      counts[place] = around.size();
      if (isLinear)
      {
        evaluator.writeWeights(around, weights.data() + laneCount * needed * place);
      }
      for (std::size_t i = 0; i < around.size(); ++i)
      {
        const NearSample<TSample>& near = search.found()[i];
        found[needed * place + i] = near.begin;
        if (near.count > 1)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          coincident.push_back({ near.begin, near.count });
        }
      }
    });
  keepUnique(coincident);

  TreeIndexNumbers numbers(tree.samples.size());
  result.begins.assign(1, 0);
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    const std::size_t first = needed * place;
    for (std::size_t i = first; i < first + counts[place]; ++i)
    {
      numbers.add(found[i]);
    }
    result.begins.push_back(result.begins.back() + counts[place]);
  }
  const std::size_t positions = numbers.finish();
  if (positions > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("neighborhoods have more positions than can be numbered");
  }
  result.around.resize(result.begins.back());
  result.weights.resize(isLinear ? laneCount * result.around.size() : 0);
  result.positions.resize(positions);
  std::vector<std::size_t> inTree(positions); // tree indices
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    for (std::size_t i = 0; i < counts[place]; ++i)
    {
      const std::size_t at = result.begins[place] + i;
      const std::size_t from = needed * place + i;
      const std::size_t number = numbers.at(found[from]);
      result.around[at] = static_cast<std::uint32_t>(number);
      inTree[number] = found[from];
      for (std::size_t k = 0; k < laneCount && isLinear; ++k)
      {
        result.weights[laneCount * at + k] = weights[laneCount * from + k];
      }
    }
  }
  result.idBegins.assign(1, 0);
  auto next = coincident.begin();
  for (std::size_t number = 0; number < positions; ++number)
  {
    const TSample* const samples = tree.samples.data() + inTree[number];
    result.positions[number] = positionOf(*samples);
    const bool areMany = next != coincident.end() && next->begin == inTree[number];
    const std::size_t count = areMany ? (next++)->count : 1;
    for (std::size_t i = 0; i < count; ++i)
    {
      result.ids.push_back(samples[i].id);
    }
    result.idBegins.push_back(result.ids.size());
  }
  return result;
}

} // namespace isopoint
