// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/ConcurrentMemo.h"
#include "Core/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// Samples at one position. They count as one, with the lowest id and the mean attributes.
struct CoincidentSamples
{
  std::vector<std::uint64_t> ids; // ascending, at least two
  bool haveOneValue = true;
};

/// The mean of coincident samples' values, summed by ascending id and clamped to their range.
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

template <class TSample>
double meanOfLeaf(const SampleTree<TSample>& tree, const Node<TSample>& leaf)
{
  const TSample* const samples = tree.samples.data() + leaf.begin;
  return meanOf(
    leaf.count(), [samples](std::size_t i) { return static_cast<double>(samples[i].value); });
}

/// The values of leaves; thread-safe. Those of leaves with many samples are kept.
template <class TSample>
class LeafValues
{
public:
  explicit LeafValues(const SampleTree<TSample>& tree)
    : Tree(tree)
  {
  }

  /// O(1), except for the first request for a leaf of over 64 samples. @throws std::bad_alloc
  double at(std::size_t nodeIndex)
  {
    constexpr std::size_t fewSamples = 64; // mostly faster to add up than to look up
    const Node<TSample>& leaf = this->Tree.nodes[nodeIndex];
    if (leaf.count() == 1)
    {
      return static_cast<double>(leaf.minimum); // the sample's value, already in cache
    }
    return leaf.count() <= fewSamples
             ? meanOfLeaf(this->Tree, leaf)
             : this->Means.at(nodeIndex, [&]() { return meanOfLeaf(this->Tree, leaf); });
  }

private:
  const SampleTree<TSample>& Tree;
  ConcurrentMemo<double> Means; // by node index
};

} // namespace isopoint
