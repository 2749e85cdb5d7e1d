// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LeafValues_h
#define isopoint_LeafValues_h

#include "Isopoint.h"
#include "SampleTree.h"
#include "SlotMemory.h"

#include <cstddef>
#include <unordered_map>

namespace isopoint
{

template <class TSample>
double meanOfLeaf(const SampleTree<TSample>& tree, const Node<TSample>& leaf)
{
  const TSample* const samples = tree.samples.data() + leaf.begin;
  return meanOf(
    leaf.count(), [samples](std::size_t i) { return static_cast<double>(samples[i].value); });
}

/// The means of very large heaps, each computed by about one of the threads that share them.
template <class TSample>
class HeapMeans
{
public:
  explicit HeapMeans(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(1) but for the first time a leaf of over 4096 samples is asked for. From any thread.
  /// @throws std::bad_alloc
  double at(std::size_t slot)
  {
    constexpr std::size_t manySamples = 4096;
    const Node<TSample>& leaf = this->Tree.nodes[slot];
    if (leaf.count() <= manySamples)
    {
      return meanOfLeaf(this->Tree, leaf);
    }
    return this->Means.at(slot, [&]() { return meanOfLeaf(this->Tree, leaf); });
  }

private:
  const SampleTree<TSample>& Tree;
  SlotMemory<double> Means;
};

/// The values of leaves: the means of their samples, which count as one. Those of heaps are
/// remembered, since many cells may touch one. For one thread.
template <class TSample>
class LeafValues
{
public:
  /// @param heapMeans of the same tree
  LeafValues(const SampleTree<TSample>& tree, HeapMeans<TSample>& heapMeans)
    : Tree(tree)
    , Shared(heapMeans)
  {
  }

  /// O(1) but for the first time a heap is asked for.
  /// @throws std::bad_alloc
  double at(std::size_t slot)
  {
    constexpr std::size_t fewSamples = 16;
    const Node<TSample>& leaf = this->Tree.nodes[slot];
    if (leaf.count() == 1)
    {
      return static_cast<double>(this->Tree.samples[leaf.begin].value);
    }
    if (leaf.count() <= fewSamples)
    {
      return meanOfLeaf(this->Tree, leaf);
    }
    const auto found = this->Heaps.find(slot);
    return found != this->Heaps.end()
             ? found->second
             : this->Heaps.emplace(slot, this->Shared.at(slot)).first->second;
  }

private:
  const SampleTree<TSample>& Tree;
  HeapMeans<TSample>& Shared;
  std::unordered_map<std::size_t, double> Heaps; // by slot
};

} // namespace isopoint

#endif
