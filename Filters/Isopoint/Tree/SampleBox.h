// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleBox_h
#define isopoint_SampleBox_h

#include "Isopoint/Tree/SampleTree.h"

#include <algorithm>
#include <cstddef>

namespace isopoint
{

/// The bounding box of some samples.
template <class TSample>
struct SampleBox
{
  typename TSample::Coordinate lower[3];
  typename TSample::Coordinate upper[3];
};

/// The bounding box of two.
template <class TSample>
SampleBox<TSample> united(const SampleBox<TSample>& a, const SampleBox<TSample>& b)
{
  SampleBox<TSample> box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    box.upper[axis] = std::max(a.upper[axis], b.upper[axis]);
  }
  return box;
}

/// The bounding box of a node's samples. O(samples of the node), O(1) for a leaf
template <class TSample>
SampleBox<TSample> boxOfSamples(const SampleTree<TSample>& tree, const Node<TSample>& node)
{
  const auto boxOf = [](const TSample& sample)
  {
    SampleBox<TSample> box;
    std::copy_n(sample.position, 3, box.lower);
    std::copy_n(sample.position, 3, box.upper);
    return box;
  };
  SampleBox<TSample> box = boxOf(tree.samples[node.begin]);
  const std::size_t end = node.isLeaf ? node.begin + std::size_t{ 1 } : node.end;
  for (std::size_t i = node.begin; i < end; ++i)
  {
    box = united(box, boxOf(tree.samples[i]));
  }
  return box;
}

} // namespace isopoint

#endif
