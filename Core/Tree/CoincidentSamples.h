// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CoincidentSamples_h
#define isopoint_CoincidentSamples_h

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace isopoint
{

/// Samples at exactly one position. They count as one sample, with the lowest of their ids and the
/// mean of their values and other attributes.
struct CoincidentSamples
{
  std::vector<std::uint64_t> ids; // ascending, at least two
};

/// The mean of the values of coincident samples: summed in the order of their ids and kept within
/// their range, which the rounding of a sum may leave by a bit.
/// @param count at least 1
/// @param valueAt(i) the i-th value, as a double
template <class ValueAt>
double meanOf(std::size_t count, const ValueAt& valueAt)
{
  double sum = 0.0;
  double minimum = valueAt(0);
  double maximum = minimum;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double value = valueAt(i);
    sum += value;
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  }
  return std::min(std::max(sum / static_cast<double>(count), minimum), maximum);
}

/// The value of a leaf: its sample's, or the mean of several. O(samples of the leaf)
template <class TSample>
double meanOfLeaf(const SampleTree<TSample>& tree, const Node<TSample>& leaf)
{
  const TSample* const samples = tree.samples.data() + leaf.begin;
  return meanOf(
    leaf.count(), [samples](std::size_t i) { return static_cast<double>(samples[i].value); });
}

/// The values of leaves with very many coincident samples, shared by all threads.
template <class TSample>
class SharedLeafMeans
{
public:
  explicit SharedLeafMeans(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// The value of a leaf: O(1), but at the first request for a leaf of over 4096 samples. From any
  /// thread.
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

/// The values of leaves, for one thread. Those of many coincident samples are kept, since many
/// cells may touch such a leaf.
template <class TSample>
class LeafValueCache
{
public:
  /// @param shared of the same tree
  LeafValueCache(const SampleTree<TSample>& tree, SharedLeafMeans<TSample>& shared)
    : Tree(tree)
    , Shared(shared)
  {
  }

  /// The value of a leaf: O(1), but at the first request for one with many samples.
  /// @throws std::bad_alloc
  double at(std::size_t nodeIndex)
  {
    constexpr std::size_t fewSamples = 16;
    const Node<TSample>& leaf = this->Tree.nodes[nodeIndex];
    if (leaf.count() == 1)
    {
      return static_cast<double>(leaf.minimum); // the sample's value, without a look at the sample
    }
    if (leaf.count() <= fewSamples)
    {
      return meanOfLeaf(this->Tree, leaf);
    }
    const auto found = this->Means.find(nodeIndex);
    return found != this->Means.end()
             ? found->second
             : this->Means.emplace(nodeIndex, this->Shared.at(nodeIndex)).first->second;
  }

private:
  const SampleTree<TSample>& Tree;
  SharedLeafMeans<TSample>& Shared;
  std::unordered_map<std::size_t, double> Means; // by node index
};

} // namespace isopoint

#endif
