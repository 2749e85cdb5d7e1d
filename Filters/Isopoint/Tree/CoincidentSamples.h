// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CoincidentSamples_h
#define isopoint_CoincidentSamples_h

#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

} // namespace isopoint

#endif
