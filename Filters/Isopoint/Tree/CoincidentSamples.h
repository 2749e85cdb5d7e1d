// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CoincidentSamples_h
#define isopoint_CoincidentSamples_h

#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
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

/// The coincident samples of leaves, ordered by lowest id.
/// @param leaves node indices of leaves with several samples each, in any order, with repetitions
template <class TSample>
std::vector<CoincidentSamples> coincidentSamplesOf(
  const SampleTree<TSample>& tree, std::vector<std::size_t> leaves)
{
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  std::vector<CoincidentSamples> result;
  for (const std::size_t nodeIndex : leaves)
  {
    const Node<TSample>& leaf = tree.nodes[nodeIndex];
    CoincidentSamples group;
    for (std::size_t i = leaf.begin; i < leaf.end; ++i)
    {
      group.ids.push_back(tree.samples[i].id);
    }
    result.push_back(std::move(group));
  }
  std::sort(result.begin(), result.end(),
    [](const CoincidentSamples& a, const CoincidentSamples& b)
    { return a.ids.front() < b.ids.front(); });
  return result;
}

} // namespace isopoint

#endif
