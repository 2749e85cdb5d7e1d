// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Sets of connected vertices, each named by its lowest: a forest in which all threads hang higher
/// roots below lower ones. Thread-safe.
class ConnectedVertices
{
public:
  /// At first each vertex is a set. @throws std::bad_alloc, Aborted
  ConnectedVertices(const Execution& execution, std::size_t count)
    : Parents(count)
  {
    forEachIndex(execution, count,
      [this](std::size_t vertex)
      { this->Parents[vertex].store(vertex, std::memory_order_relaxed); });
  }

  /// The lowest vertex of a set, once all are united.
  std::size_t rootOf(std::size_t vertex)
  {
    constexpr auto relaxed = std::memory_order_relaxed;
    for (std::size_t parent = this->Parents[vertex].load(relaxed); parent != vertex;
         parent = this->Parents[vertex].load(relaxed))
    {
      // Halves the path for later calls.
      this->Parents[vertex].store(this->Parents[parent].load(relaxed), relaxed);
      vertex = parent;
    }
    return vertex;
  }

  /// The roots of all vertices. @throws std::bad_alloc, Aborted
  std::vector<std::size_t> roots(const Execution& execution)
  {
    return tabulated<std::size_t>(
      execution, this->Parents.size(), [this](std::size_t vertex) { return this->rootOf(vertex); });
  }

  void unite(std::size_t a, std::size_t b)
  {
    for (;;)
    {
      const auto [low, high] = std::minmax({ this->rootOf(a), this->rootOf(b) });
      std::size_t expected = high;
      if (low == high || this->Parents[high].compare_exchange_strong(expected, low))
      {
        return;
      }
    }
  }

private:
  std::vector<std::atomic<std::size_t>> Parents; // itself for roots
};

} // namespace isopoint
