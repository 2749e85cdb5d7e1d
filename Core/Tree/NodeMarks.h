// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Bits for each node of a tree, by node index; each bit can be set from any thread.
class NodeMarks
{
public:
  /// Makes room for this many nodes; new ones have no marks. @throws std::bad_alloc
  void grow(std::size_t nodeCount)
  {
    if (nodeCount <= this->Marks.size())
    {
      return;
    }
    std::vector<std::atomic<std::uint8_t>> grown(nodeCount);
    for (std::size_t i = 0; i < this->Marks.size(); ++i)
    {
      grown[i].store(this->Marks[i].load(std::memory_order_relaxed), std::memory_order_relaxed);
    }
    this->Marks.swap(grown);
  }

  /// Whether a node has all of these marks.
  bool has(std::size_t node, std::uint8_t marks) const
  {
    return (this->Marks[node].load(std::memory_order_relaxed) & marks) == marks;
  }

  void set(std::size_t node, std::uint8_t marks)
  {
    if (!this->has(node, marks)) // mostly it has: do not write to the cache line
    {
      this->Marks[node].fetch_or(marks, std::memory_order_relaxed);
    }
  }

private:
  std::vector<std::atomic<std::uint8_t>> Marks;
};

} // namespace isopoint
