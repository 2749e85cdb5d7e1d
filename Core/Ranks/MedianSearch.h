// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ProcessGroup.h"
#include "Core/Base/Region.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// A node whose samples are spread over the ranks; each has a consecutive range, in any order.
struct DistributedNode
{
  std::size_t nodeIndex;
  Region region;
  std::size_t begin; // of this rank's samples among those it has loaded
  std::size_t end;
  std::uint64_t count; // on all ranks
};

/// The first sample of a node's upper half by the definition (docs/algorithm.md, section 3).
struct MiddleSample
{
  int axis;                          // on which the node is halved
  std::array<std::uint64_t, 4> keys; // ordered keys from that axis on, and id
};

/// Finds the middles of several nodes at once, exactly, by counting: each round counts a node's
/// samples in intervals of keys, and keeps the interval with the middle. Equal coordinates are told
/// apart by the next coordinate, finally by id.
template <class TSample>
class MedianSearch
{
public:
  /// @param samples this rank's; must not move meanwhile
  /// @param idCount above every id
  MedianSearch(ProcessGroup& processes, const TSample* samples, std::uint64_t idCount)
    : Processes(processes)
    , Samples(samples)
    , IdCount(idCount)
  {
  }

  /// Collective. Takes about two rounds for samples at distinct positions; at most eleven rounds
  /// per coordinate where they coincide.
  /// @param nodes of at least two samples each
  /// @throws std::bad_alloc, FailedElsewhere
  std::vector<MiddleSample> find(const std::vector<DistributedNode>& nodes)
  {
    this->begin(nodes);
    for (;;)
    {
      std::vector<std::size_t> open;
      std::vector<std::uint64_t> counts;
      for (std::size_t i = 0; i < this->Searches.size(); ++i)
      {
        if (this->Searches[i].size > 1)
        {
          open.push_back(i);
        }
      }
      this->count(open, counts);
      if (open.empty())
      {
        return this->middles();
      }
      this->Processes.sum(counts);
      this->narrow(open, counts);
    }
  }

private:
  static constexpr int idStage = 3;

  /// The search for a node's middle among the samples with keys in an interval.
  struct Search
  {
    const DistributedNode* node;
    int axis;
    int stage;                           // which key is compared
    std::uint64_t low;                   // first key of the interval
    std::uint64_t high;                  // last key of the interval
    std::uint64_t rank;                  // of the middle among the samples in it
    std::uint64_t size;                  // their number on all ranks
    bool isWhole;                        // whether all of the node's samples are in it
    std::vector<std::size_t> candidates; // this rank's, unless it is whole
  };

  void begin(const std::vector<DistributedNode>& nodes)
  {
    this->Searches.clear();
    for (const DistributedNode& node : nodes)
    {
      Search search{ &node, node.region.longestSide(), 0, 0, 0, node.count / 2, node.count, true,
        {} };
      this->beginStage(search);
      this->Searches.push_back(search);
    }
  }

  void beginStage(Search& search) const
  {
    if (search.stage == idStage)
    {
      search.low = 0;
      search.high = this->IdCount - 1;
      return;
    }
    const auto axis = static_cast<std::size_t>((search.axis + search.stage) % 3);
    search.low = orderedKey(search.node->region.lower[axis]);
    search.high = orderedKey(search.node->region.upper[axis]);
  }

  static std::uint64_t keyOf(const TSample& sample, const Search& search, int stage)
  {
    return stage == idStage
             ? static_cast<std::uint64_t>(sample.id)
             : orderedKey(static_cast<double>(sample.position[(search.axis + stage) % 3]));
  }

  template <class Visitor>
  void forEachCandidate(const Search& search, const Visitor& visit) const
  {
    if (!search.isWhole)
    {
      std::for_each(search.candidates.begin(), search.candidates.end(), visit);
      return;
    }
    for (std::size_t i = search.node->begin; i < search.node->end; ++i)
    {
      visit(i);
    }
  }

  /// The binary logarithm of the number of intervals that each current one is divided into.
  static int bitsFor(std::size_t openCount)
  {
    constexpr int most = 14; // counters that fit into a fast cache
    constexpr std::size_t all = std::size_t{ 1 } << 17;
    int bits = most;
    while (bits > 1 && (openCount << bits) > all)
    {
      --bits;
    }
    return bits;
  }

  static int shiftFor(const Search& search, int bits)
  {
    return std::max(0, highestBit((search.high - search.low) | 1) + 1 - bits);
  }

  void count(const std::vector<std::size_t>& open, std::vector<std::uint64_t>& counts)
  {
    this->Bits = bitsFor(open.size());
    counts.assign(open.size() << this->Bits, 0);
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      const Search& search = this->Searches[open[i]];
      const int shift = shiftFor(search, this->Bits);
      std::uint64_t* const counters = counts.data() + (i << this->Bits);
      this->forEachCandidate(search,
        [&](std::size_t sample) {
          ++counters[(keyOf(this->Samples[sample], search, search.stage) - search.low) >> shift];
        });
    }
  }

  void narrow(const std::vector<std::size_t>& open, const std::vector<std::uint64_t>& counts)
  {
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      Search& search = this->Searches[open[i]];
      const int shift = shiftFor(search, this->Bits);
      const std::uint64_t* counter = counts.data() + (i << this->Bits);
      while (search.rank >= *counter)
      {
        search.rank -= *counter++;
        search.low += std::uint64_t{ 1 } << shift;
      }
      search.high = std::min(search.high, search.low + ((std::uint64_t{ 1 } << shift) - 1));
      if (*counter < search.size)
      {
        search.size = *counter;
        this->keepCandidates(search);
      }
      if (search.size > 1 && search.low == search.high)
      {
        ++search.stage;
        this->beginStage(search);
      }
    }
  }

  void keepCandidates(Search& search) const
  {
    std::vector<std::size_t> kept;
    this->forEachCandidate(search,
      [&](std::size_t sample)
      {
        const std::uint64_t key = keyOf(this->Samples[sample], search, search.stage);
        if (search.low <= key && key <= search.high)
        {
          kept.push_back(sample);
        }
      });
    search.candidates.swap(kept);
    search.isWhole = false;
  }

  /// The samples found, each of them on one rank.
  std::vector<MiddleSample> middles()
  {
    std::vector<std::uint64_t> keys;
    for (const Search& search : this->Searches)
    {
      for (int stage = 0; stage <= idStage; ++stage)
      {
        keys.push_back(search.candidates.empty()
                         ? 0
                         : keyOf(this->Samples[search.candidates.front()], search, stage));
      }
    }
    this->Processes.sum(keys);
    std::vector<MiddleSample> result(this->Searches.size());
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      result[i].axis = this->Searches[i].axis;
      std::copy_n(keys.data() + 4 * i, 4, result[i].keys.begin());
    }
    return result;
  }

  ProcessGroup& Processes;
  const TSample* Samples;
  std::uint64_t IdCount;
  int Bits = 0;
  std::vector<Search> Searches;
};

} // namespace isopoint
