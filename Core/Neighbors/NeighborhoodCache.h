// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Base/RawArray.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace isopoint
{

/// The neighborhoods of leaves near surfaces extracted before. They do not depend on isovalues,
/// angles or values, and searching them is most of the work if the tree is already refined. Memory:
/// one number per neighbor and per node, two per neighborhood.
template <class TId>
class NeighborhoodCache
{
public:
  /// The neighborhood of a leaf; an empty list if it is not known. O(1)
  IndexSpan<TId> at(std::size_t nodeIndex) const
  {
    if (nodeIndex >= this->Offsets.size() || this->Offsets[nodeIndex] == 0)
    {
      return {};
    }
    const TId* const list = this->Lists.data() + this->Offsets[nodeIndex];
    return { list + 1, static_cast<std::size_t>(list[0]) };
  }

  /// How many more numbers fit within a limit.
  std::size_t room(std::size_t limit) const
  {
    const std::size_t largest = std::min<std::size_t>(limit, std::numeric_limits<TId>::max());
    return largest > this->Lists.size() ? largest - this->Lists.size() : 0;
  }

  /// Adds neighborhoods, each stored as node index, count, neighbors.
  /// @param nodeCount above every node index
  /// @throws std::bad_alloc, after which some of them may be known
  void add(
    const Execution& execution, const std::vector<std::vector<TId>>& lists, std::size_t nodeCount)
  {
    const std::vector<std::size_t> begins = offsetsOf(lists, this->Lists.size());
    this->Offsets.resize(std::max(this->Offsets.size(), nodeCount), 0);
    this->Lists.resize(begins.back());
    forEachList(execution, begins, [&](std::size_t list) { this->set(begins[list], lists[list]); });
  }

private:
  void set(std::size_t begin, const std::vector<TId>& neighborhoods)
  {
    std::copy(neighborhoods.begin(), neighborhoods.end(), this->Lists.data() + begin);
    for (std::size_t i = 0; i < neighborhoods.size();)
    {
      const auto node = static_cast<std::size_t>(neighborhoods[i]);
      this->Offsets[node] = static_cast<TId>(begin + i + 1);
      i += 2 + neighborhoods[i + 1];
    }
  }

  std::vector<TId> Offsets; // by node index, into Lists; 0: not known
  RawArray<TId> Lists;      // node, count, neighbors
};

/// A budget of listed neighbors, shared by all threads. Listing is faster than searching for small
/// neighborhoods and a few large ones, but the neighborhoods of n samples can have n^2 neighbors.
/// The budget limits the listed large ones to O(n) neighbors; once it is spent, neighborhoods are
/// searched (see ImplicitNeighborhood). Results do not depend on it.
class NeighborListBudget
{
public:
  explicit NeighborListBudget(std::size_t sampleCount)
    : Remaining(static_cast<std::int64_t>(sampleCount))
  {
  }

  bool isSpent() const { return this->Remaining.load(std::memory_order_relaxed) <= 0; }

  /// Accounts for a listed neighborhood; small ones are free.
  void spend(std::size_t neighborCount)
  {
    constexpr std::size_t few = 64;
    if (neighborCount > few)
    {
      this->Remaining.fetch_sub(
        static_cast<std::int64_t>(neighborCount), std::memory_order_relaxed);
    }
  }

private:
  std::atomic<std::int64_t> Remaining;
};

} // namespace isopoint
