// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Lists.h"
#include "Core/Extraction/IsopointNeighbors.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Extraction/SingleRank.h"
#include "Core/Neighbors/NeighborhoodCache.h"
#include "Core/Tree/SampleTree.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// The points that this rank owns and computes splats of (template parameter TOwnedPoints): all.
/// SurfaceHalo implements the same functions for several ranks.
class AllPoints
{
public:
  explicit AllPoints(std::size_t count)
    : Indices(iota(count))
  {
  }

  /// The points whose cells are cut on this rank; consecutive points should be close.
  const std::vector<std::size_t>& own() const { return this->Indices; }

  /// The points whose shapes are made on this rank.
  const std::vector<std::size_t>& shaped() const { return this->Indices; }

  /// Removes the points of other ranks from an ascending list.
  void keepOwn(std::vector<std::size_t>& /*points*/) const {}

  /// See SingleRank::forEach().
  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone) const
  {
    forEachItem(execution, batches, makeWorker, work, batchDone);
  }

  /// Sets the entries of other ranks' points, one entry per point.
  template <class TList>
  void share(TList& /*ofAll*/) const
  {
  }

  /// Sets the cells of other ranks' points, which refer to points.
  template <class TCells>
  void shareCells(TCells& /*cells*/) const
  {
  }

private:
  std::vector<std::size_t> Indices;
};

/// The isopoints of one process. SurfaceHalo implements the same functions, and those of AllPoints,
/// for several ranks:
/// - gather(rings, isShared): fetches rings of other ranks' isopoints, none or at least 3.
///   isShared: whether share() sends all results to ranks with copies, or only normals;
/// - surface(): all isopoints, each once, without coincident samples;
/// - numbers(): numbers that break ties between points; empty if their indices do;
/// - inner(): per isopoint, whether neighbors are needed around it; null for all;
/// - owned(), ghosts(): indices of this rank's isopoints, and of all others;
/// - takeOwned(): moves out the surface of owned().
template <class TSample>
class WholeSurface : public AllPoints
{
public:
  WholeSurface(const Execution& execution, SingleRank<TSample>& /*ranks*/,
    const SampleTree<TSample>& tree, const NeighborhoodCache<typename TSample::Id>& /*known*/,
    Isosurface whole, bool /*hasFits*/)
    : AllPoints(whole.size())
    , Run(execution)
    , Tree(tree)
    , Whole(std::move(whole))
  {
  }

  /// Consecutive points are close, so that their surroundings are in cache.
  void gather(int rings, bool /*isShared*/)
  {
    if (rings == 0)
    {
      return;
    }
    this->Order = inOrderOfLeaves(this->Run, this->Whole.leaves, this->Tree.nodes.size());
    this->Ordered = chosenIsopoints(this->Run, this->Whole, this->Order);
  }

  const Isosurface& surface() const { return this->Ordered; }
  const std::vector<std::size_t>& numbers() const { return this->Order; }
  const std::vector<bool>* inner() const { return nullptr; }

  std::vector<std::size_t> owned() const
  {
    return inverseOf(this->Run, this->Order, this->Order.size());
  }
  std::vector<std::size_t> ghosts() const { return {}; }

  Isosurface takeOwned() { return std::move(this->Whole); }

private:
  const Execution& Run;
  const SampleTree<TSample>& Tree;
  Isosurface Whole;
  std::vector<std::size_t> Order;
  Isosurface Ordered;
};

} // namespace isopoint
