// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_LeafValueCache_h
#define isopoint_LeafValueCache_h

#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Tree/SampleTree.h"
#include "Isopoint/Base/ConcurrentMemo.h"

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
class SharedLeafMeans
{
public:
  explicit SharedLeafMeans(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(1) but for the first time a leaf of over 4096 samples is asked for. From any thread.
  /// @throws std::bad_alloc
  double at(std::size_t nodeIndex)
  {
    constexpr std::size_t manySamples = 4096;
    const Node<TSample>& leaf = this->Tree.nodes[nodeIndex];
    if (leaf.count() <= manySamples)
    {
      return meanOfLeaf(this->Tree, leaf);
    }
    return this->Means.at(nodeIndex, [&]() { return meanOfLeaf(this->Tree, leaf); });
  }

private:
  const SampleTree<TSample>& Tree;
  ConcurrentMemo<double> Means;
};

/// The values of leaves: the means of their samples, which count as one. Those of heaps are
/// remembered, since many cells may touch one. For one thread.
template <class TSample>
class LeafValueCache
{
public:
  /// @param leafMeans of the same tree
  LeafValueCache(const SampleTree<TSample>& tree, SharedLeafMeans<TSample>& leafMeans)
    : Tree(tree)
    , Shared(leafMeans)
  {
  }

  /// O(1) but for the first time a heap is asked for.
  /// @throws std::bad_alloc
  double at(std::size_t nodeIndex)
  {
    constexpr std::size_t fewSamples = 16;
    const Node<TSample>& leaf = this->Tree.nodes[nodeIndex];
    if (leaf.count() == 1)
    {
      return static_cast<double>(this->Tree.samples[leaf.begin].value);
    }
    if (leaf.count() <= fewSamples)
    {
      return meanOfLeaf(this->Tree, leaf);
    }
    const auto found = this->Heaps.find(nodeIndex);
    return found != this->Heaps.end()
             ? found->second
             : this->Heaps.emplace(nodeIndex, this->Shared.at(nodeIndex)).first->second;
  }

private:
  const SampleTree<TSample>& Tree;
  SharedLeafMeans<TSample>& Shared;
  std::unordered_map<std::size_t, double> Heaps; // by nodeIndex
};

} // namespace isopoint

#endif
