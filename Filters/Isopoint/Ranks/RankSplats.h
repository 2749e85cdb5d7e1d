// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_RankSplats_h
#define isopoint_RankSplats_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Extraction/IsopointNeighbors.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/Rounds.h"
#include "Isopoint/Ranks/SurfaceHalo.h"
#include "Isopoint/Splat/NearbyPoints.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatNormals.h"
#include "Isopoint/Splat/SplatShaper.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

namespace isopoint
{

/// What computeSplats() does, for the isopoints of one of several ranks. All functions are
/// collective.
template <class TSample>
class RankSplats
{
public:
  using Neighborhoods = NeighborhoodCache<typename TSample::Id>;
  using Neighbors = IsopointNeighbors<TSample>;

  RankSplats(const Execution& execution, NodeExchange<TSample>& exchange,
    const Neighborhoods& known, const SplatOptions& options)
    : Run(execution)
    , Exchange(exchange)
    , Known(known)
    , Options(options)
  {
  }

  /// @param halo gathered
  /// @param isShaped which of this rank's isopoints are to have shapes; all get normals
  /// @param isShared whether what this rank computes for its isopoints is sent to the ranks in
  /// whose halo they are; otherwise those have normals alone there
  /// @returns one splat for each isopoint of the halo's surface
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<Splat> compute(
    SurfaceHalo<TSample>& halo, const std::vector<bool>& isShaped, bool isShared)
  {
    const Isosurface& all = halo.surface();
    const SurfacePoints points{ all.positions, all.decreasingEdges, all.fits };
    std::vector<Splat> splats;
    std::unique_ptr<Neighbors> neighbors;
    this->Exchange.together(
      [&]()
      {
        splats.resize(all.size());
        neighbors = std::make_unique<Neighbors>(
          this->Run, this->Exchange.tree(), this->Known, all.leaves, &halo.isInner());
      });
    this->setNormals(halo, points, *neighbors, splats);
    this->shareNormals(halo, splats);
    this->shape(halo, points, *neighbors, isShaped, splats);
    if (isShared)
    {
      halo.share(splats);
    }
    return splats;
  }

private:
  void setNormals(const SurfaceHalo<TSample>& halo, const SurfacePoints& points,
    const Neighbors& neighbors, std::vector<Splat>& splats)
  {
    std::vector<std::size_t> unfitted; // of this rank's
    this->Exchange.together(
      [&]()
      {
        const std::vector<std::size_t> ofAll = setFieldNormals(points, this->Options, splats);
        std::set_intersection(ofAll.begin(), ofAll.end(), halo.ownIndices().begin(),
          halo.ownIndices().end(), std::back_inserter(unfitted));
      });
    const auto count = static_cast<std::size_t>(this->Options.neighborCount);
    inRounds(
      this->Run, this->Exchange, unfitted.size(),
      [&]() { return NearbyPoints<Neighbors>(neighbors, points.positions); },
      [&](NearbyPoints<Neighbors>& nearby, std::size_t i)
      {
        const std::size_t point = unfitted[i];
        std::vector<std::size_t> around;
        nearby.nearest(point, lengthOf(points.decreasingEdges[point]), count, around);
        splats[point].normal = planeNormal(points, point, around);
      });
  }

  void shareNormals(SurfaceHalo<TSample>& halo, std::vector<Splat>& splats)
  {
    std::vector<Vector> normals;
    this->Exchange.together(
      [&]()
      {
        for (const Splat& splat : splats)
        {
          normals.push_back(splat.normal);
        }
      });
    halo.share(normals);
    // The ends of an edge between two ranks yield the same normal on both.
    for (std::size_t i = 0; i < splats.size(); ++i)
    {
      splats[i].normal = normals[i];
    }
  }

  void shape(const SurfaceHalo<TSample>& halo, const SurfacePoints& points,
    const Neighbors& neighbors, const std::vector<bool>& isShaped, std::vector<Splat>& splats)
  {
    using Extents = SampleExtents<TSample>;
    const Extents extents(this->Exchange.tree());
    std::vector<std::size_t> order;
    this->Exchange.together(
      [&]()
      {
        std::vector<bool> isWanted(splats.size(), false);
        for (std::size_t i = 0; i < isShaped.size(); ++i)
        {
          isWanted[halo.ownIndices()[i]] = isShaped[i] && this->Options.shapes;
        }
        for (const std::size_t point : neighbors.inOrder())
        {
          if (isWanted[point])
          {
            order.push_back(point);
          }
        }
      });
    inRounds(
      this->Run, this->Exchange, order.size(),
      [&]() { return SplatShaper<Neighbors, Extents>(neighbors, points, &extents, splats); },
      [&](SplatShaper<Neighbors, Extents>& shaper, std::size_t i)
      { shaper.shape(order[i], splats[order[i]]); });
  }

  const Execution& Run;
  NodeExchange<TSample>& Exchange;
  const Neighborhoods& Known;
  const SplatOptions Options;
};

} // namespace isopoint

#endif
