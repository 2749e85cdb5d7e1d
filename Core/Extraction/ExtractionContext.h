// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/CoincidentSamples.h"
#include "Core/Tree/SampleBounds.h"
#include "Core/Tree/SampleTree.h"

#include <atomic>
#include <cstdint>

namespace isopoint
{

/// Data shared by the threads of one extraction. Results depend only on the tree and the isovalue.
template <class TSample>
struct ExtractionContext
{
  using Neighborhoods = NeighborhoodCache<typename TSample::Id>;

  /// @param extractedTree refined around the isovalue
  /// @param knownNeighborhoods of that tree; must not change meanwhile
  ExtractionContext(const SampleTree<TSample>& extractedTree,
    const Neighborhoods& knownNeighborhoods, double extractedIsovalue)
    : tree(extractedTree)
    , neighborhoods(knownNeighborhoods)
    , isovalue(extractedIsovalue)
    , bounds(tree)
    , leafValues(tree)
    , listBudget(tree.isPartial ? unlimited : tree.samples.size())
    , cacheBudget(static_cast<std::int64_t>(neighborhoods.room(2 * tree.ownCount())))
  {
  }

  /// On several ranks, searches without lists are impossible: they need the boxes of all samples.
  static constexpr std::size_t unlimited = std::size_t{ 1 } << 62;

  const SampleTree<TSample>& tree;
  const Neighborhoods& neighborhoods;
  const double isovalue;
  SampleBounds<TSample> bounds;
  LeafValues<TSample> leafValues;
  NeighborListBudget listBudget;
  std::atomic<std::int64_t> cacheBudget; // numbers that may still be cached
};

} // namespace isopoint
