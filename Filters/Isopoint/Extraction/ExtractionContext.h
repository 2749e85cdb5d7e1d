// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractionContext_h
#define isopoint_ExtractionContext_h

#include "Isopoint/Tree/LeafValueCache.h"
#include "Isopoint/Neighbors/NeighborListBudget.h"
#include "Isopoint/Tree/SampleBounds.h"
#include "Isopoint/Tree/SampleTree.h"

#include <atomic>
#include <cstdint>

namespace isopoint
{

/// What the threads of an extraction share, beside the tree. No result depends on it.
template <class TSample>
struct ExtractionContext
{
  explicit ExtractionContext(const SampleTree<TSample>& tree)
    : bounds(tree)
    , leafMeans(tree)
    , limit(tree.samples.size())
    , room(static_cast<std::int64_t>(tree.neighborhoods.room(tree.samples.size())))
  {
  }

  SampleBounds<TSample> bounds;
  SharedLeafMeans<TSample> leafMeans;
  NeighborListBudget limit;
  std::atomic<std::int64_t> room; // how many more numbers of neighbourhoods are worth keeping
};

} // namespace isopoint

#endif
