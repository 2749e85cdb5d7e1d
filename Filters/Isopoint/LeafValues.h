// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LeafValues_h
#define isopoint_LeafValues_h

#include "Isopoint.h"
#include "SampleTree.h"

#include <cstddef>
#include <unordered_map>

namespace isopoint
{

/// The values of leaves: the means of their samples, which count as one. Those of large heaps are
/// remembered, since many cells may touch one. For one thread.
template <class TSample>
class LeafValues
{
public:
  explicit LeafValues(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(1) but for the first time a heap is asked for.
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
      return this->mean(leaf);
    }
    const auto [found, isNew] = this->Heaps.try_emplace(slot, 0.0);
    if (isNew)
    {
      found->second = this->mean(leaf);
    }
    return found->second;
  }

private:
  double mean(const Node<TSample>& leaf) const
  {
    const TSample* const samples = this->Tree.samples.data() + leaf.begin;
    return meanOf(
      leaf.count(), [samples](std::size_t i) { return static_cast<double>(samples[i].value); });
  }

  const SampleTree<TSample>& Tree;
  std::unordered_map<std::size_t, double> Heaps; // by slot
};

} // namespace isopoint

#endif
