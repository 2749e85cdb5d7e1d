// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SharedState_h
#define isopoint_SharedState_h

#include "LeafValues.h"
#include "ListingLimit.h"
#include "SampleBounds.h"
#include "SampleTree.h"

#include <atomic>
#include <cstdint>

namespace isopoint
{

/// What the threads of an extraction share, beside the tree. No result depends on it.
template <class TSample>
struct SharedState
{
  explicit SharedState(const SampleTree<TSample>& tree)
    : bounds(tree)
    , heapMeans(tree)
    , limit(tree.samples.size())
    , room(static_cast<std::int64_t>(tree.neighborhoods.room(tree.samples.size())))
  {
  }

  SampleBounds<TSample> bounds;
  HeapMeans<TSample> heapMeans;
  ListingLimit limit;
  std::atomic<std::int64_t> room; // how many more numbers of neighbourhoods are worth keeping
};

} // namespace isopoint

#endif
