// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_WholeSurface_h
#define isopoint_WholeSurface_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Extraction/SingleRank.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Splat/SplatGeometry.h"
#include "Isopoint/Tree/SampleTree.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace isopoint
{

/// The isopoints of the one rank, which has all: what SurfaceHalo is for several ranks, whose
/// functions are described there.
template <class TSample>
class WholeSurface : public AllPoints
{
public:
  WholeSurface(const Execution& /*execution*/, SingleRank<TSample>& /*ranks*/,
    const SampleTree<TSample>& tree, const NeighborhoodCache<typename TSample::Id>& /*known*/,
    Isosurface whole, bool /*hasFits*/)
    : AllPoints(whole.size())
    , Tree(tree)
    , Whole(std::move(whole))
  {
  }

  /// Close points come after each other, so that what lies around them is in the caches.
  void gather(int rings, bool /*isShared*/)
  {
    if (rings == 0)
    {
      return;
    }
    this->Order = inOrderOfLeaves(this->Whole.leaves, this->Tree.nodes.size());
    this->Ordered = chosenIsopoints(this->Whole, this->Order);
  }

  const Isosurface& surface() const { return this->Ordered; }
  const std::vector<std::size_t>& numbers() const { return this->Order; }
  const std::vector<bool>* inner() const { return nullptr; }

  std::vector<std::size_t> home() const
  {
    std::vector<std::size_t> places(this->Order.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      places[this->Order[i]] = i;
    }
    return places;
  }
  std::vector<std::size_t> elsewhere() const { return {}; }

  Isosurface takeHome() { return std::move(this->Whole); }

  void share(std::vector<Splat>& /*splats*/) const {}

private:
  const SampleTree<TSample>& Tree;
  Isosurface Whole;
  std::vector<std::size_t> Order;
  Isosurface Ordered;
};

} // namespace isopoint

#endif
