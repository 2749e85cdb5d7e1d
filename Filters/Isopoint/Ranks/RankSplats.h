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

#include <cstddef>
#include <memory>
#include <mutex>
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

  /// @param own the isopoints on edges with an end in this rank's leaves
  /// @param isShaped which of them are to have shapes; all get normals
  /// @returns one splat for each
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<Splat> compute(const Isosurface& own, const std::vector<bool>& isShaped, bool hasFits)
  {
    SurfaceHalo<TSample> halo(this->Run, this->Exchange, this->Known, own, hasFits);
    halo.gather();
    std::vector<Splat> splats;
    std::unique_ptr<Neighbors> neighbors;
    this->setNormals(halo, own, neighbors, splats);
    this->shareNormals(halo, splats);
    const Isosurface& all = halo.surface();
    const SurfacePoints points{ all.positions, all.decreasingEdges, all.fits };
    this->shape(halo, points, *neighbors, isShaped, splats);
    std::vector<Splat> result;
    this->Exchange.together(
      [&]()
      {
        for (const std::size_t index : halo.ownIndices())
        {
          result.push_back(splats[index]);
        }
      });
    return result;
  }

private:
  /// Those of the points around which fits do not determine them are computed from the points
  /// around; the halo grows as long as they need more of these.
  void setNormals(SurfaceHalo<TSample>& halo, const Isosurface& own,
    std::unique_ptr<Neighbors>& neighbors, std::vector<Splat>& splats)
  {
    std::vector<Vector> normals; // of this rank's points
    std::vector<std::size_t> unfitted;
    this->Exchange.together(
      [&]()
      {
        const SurfacePoints points{ own.positions, own.decreasingEdges, own.fits };
        std::vector<Splat> ofOwn(own.size());
        unfitted = setFieldNormals(points, this->Options, ofOwn);
        for (const Splat& splat : ofOwn)
        {
          normals.push_back(splat.normal);
        }
      });
    for (;;)
    {
      this->Exchange.together(
        [&]()
        {
          neighbors = std::make_unique<Neighbors>(
            this->Run, this->Exchange.tree(), this->Known, halo.surface().leaves, &halo.isInner());
        });
      this->setPlaneNormals(halo, *neighbors, unfitted, normals);
      if (!this->Exchange.isAny(!unfitted.empty()))
      {
        break;
      }
      halo.grow();
    }
    this->Exchange.together(
      [&]()
      {
        const Isosurface& all = halo.surface();
        const SurfacePoints points{ all.positions, all.decreasingEdges, all.fits };
        splats.resize(all.size());
        setFieldNormals(points, this->Options, splats);
        for (std::size_t i = 0; i < normals.size(); ++i)
        {
          splats[halo.ownIndices()[i]].normal = normals[i];
        }
      });
  }

  /// @param unfitted of this rank's points; those remain for which the halo is too small
  void setPlaneNormals(const SurfaceHalo<TSample>& halo, const Neighbors& neighbors,
    std::vector<std::size_t>& unfitted, std::vector<Vector>& normals)
  {
    const Isosurface& all = halo.surface();
    const SurfacePoints points{ all.positions, all.decreasingEdges, all.fits };
    const auto count = static_cast<std::size_t>(this->Options.neighborCount);
    std::vector<std::size_t> beyond;
    std::mutex mutex;
    inRounds(
      this->Run, this->Exchange, unfitted.size(),
      [&]() { return NearbyPoints<Neighbors>(neighbors, all.positions); },
      [&](NearbyPoints<Neighbors>& nearby, std::size_t i)
      {
        const std::size_t point = halo.ownIndices()[unfitted[i]];
        std::vector<std::size_t> around;
        try
        {
          nearby.nearest(point, lengthOf(all.decreasingEdges[point]), count, around);
          normals[unfitted[i]] = planeNormal(points, point, around);
        }
        catch (const MissingRing&)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          beyond.push_back(unfitted[i]);
        }
      });
    unfitted.swap(beyond);
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
