// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_NodeMarks_h
#define isopoint_NodeMarks_h

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// What is known of the nodes of a tree, by node index.
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

  /// The leaf's samples are a vertex of the band's triangulation.
  void addToBand(std::size_t leaf) { this->set(leaf, inBand); }
  bool isInBand(std::size_t leaf) const { return this->has(leaf, inBand); }

  /// The sphere of a crossing tetrahedron may reach the region of the node, which has no children.
  /// From any thread.
  void markReached(std::size_t node)
  {
    if (!this->has(node, reached)) // mostly it has: no cache line is written in vain
    {
      this->set(node, reached);
    }
  }
  bool isReached(std::size_t node) const { return this->has(node, reached); }

private:
  static constexpr std::uint8_t inBand = 1;
  static constexpr std::uint8_t reached = 2;

  bool has(std::size_t node, std::uint8_t mark) const
  {
    return (this->Marks[node].load(std::memory_order_relaxed) & mark) != 0;
  }
  void set(std::size_t node, std::uint8_t mark)
  {
    this->Marks[node].fetch_or(mark, std::memory_order_relaxed);
  }

  std::vector<std::atomic<std::uint8_t>> Marks;
};

} // namespace isopoint

#endif
