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
#include "Isopoint/Splat/CellCutter.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatCell.h"
#include "Isopoint/Splat/SplatFans.h"
#include "Isopoint/Splat/SplatNormals.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
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

  /// @param halo gathered, of fanRings or more if there are shapes
  /// @param isShaped which of this rank's isopoints are to have shapes; all get normals
  /// @param isShared whether what this rank computes for its isopoints is sent to the ranks in
  /// whose halo they are; otherwise those have normals alone there
  /// @returns one splat for each isopoint of the halo's surface
  /// @throws std::bad_alloc, Aborted, FailedElsewhere
  std::vector<Splat> compute(
    SurfaceHalo<TSample>& halo, const std::vector<bool>& isShaped, bool isShared)
  {
    const Isosurface& all = halo.surface();
    const SurfacePoints points{ all.positions, all.decreasingEdges, all.fits, {}, all.isovalue };
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
    if (this->Options.shapes)
    {
      std::vector<SplatCell> cells = this->cut(halo, points, *neighbors, splats);
      this->Exchange.together(
        [&]()
        {
          std::vector<std::size_t> shaped;
          for (std::size_t i = 0; i < isShaped.size(); ++i)
          {
            if (isShaped[i])
            {
              shaped.push_back(halo.ownIndices()[i]);
            }
          }
          shapeSplats(this->Run, points, std::move(cells), shaped, splats);
        });
    }
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
    inRounds(
      this->Run, this->Exchange, unfitted.size(),
      [&]() { return PlaneNormals<Neighbors>(neighbors, points, this->Options.neighborCount); },
      [&](PlaneNormals<Neighbors>& normals, std::size_t i)
      { splats[unfitted[i]].normal = normals.at(unfitted[i]); });
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

  /// A cell as ranks send it to each other.
  struct SentCell
  {
    SplatCell cell;
    std::array<IsopointEdge, mostCorners> beyond; // the points beyond its sides, if any
  };

  /// Cuts out the cells of this rank's isopoints, and receives those of its halo.
  std::vector<SplatCell> cut(SurfaceHalo<TSample>& halo, const SurfacePoints& points,
    const Neighbors& neighbors, const std::vector<Splat>& splats)
  {
    using Extents = SampleExtents<TSample>;
    const Extents extents(this->Exchange.tree());
    const std::vector<IsopointEdge>& edges = halo.surface().edges;
    std::vector<SentCell> sent;
    std::vector<std::size_t> own; // mostly close ones after each other
    this->Exchange.together(
      [&]()
      {
        sent.resize(splats.size(), SentCell{});
        for (const std::size_t point :
          inOrderOfLeaves(halo.surface().leaves, this->Exchange.tree().nodes.size()))
        {
          if (std::binary_search(halo.ownIndices().begin(), halo.ownIndices().end(), point))
          {
            own.push_back(point);
          }
        }
      });
    inRounds(
      this->Run, this->Exchange, own.size(),
      [&]() { return CellCutter<Neighbors, Extents>(neighbors, points, &extents, splats); },
      [&](CellCutter<Neighbors, Extents>& cutter, std::size_t i)
      {
        SentCell& to = sent[own[i]];
        to.cell = cutter.cut(own[i]);
        for (std::size_t k = 0; k < to.cell.count; ++k)
        {
          const std::size_t beyond = to.cell.corners[k].beyond;
          to.beyond[k] = beyond == SplatCell::none ? IsopointEdge{} : edges[beyond];
        }
      });
    halo.share(sent);
    std::vector<SplatCell> cells;
    this->Exchange.together(
      [&]()
      {
        for (SentCell& from : sent)
        {
          for (std::size_t k = 0; k < from.cell.count; ++k)
          {
            std::size_t& beyond = from.cell.corners[k].beyond;
            const std::size_t found =
              beyond == SplatCell::none ? splats.size() : halo.find(from.beyond[k]);
            beyond = found < splats.size() ? found : SplatCell::none;
          }
          cells.push_back(from.cell);
        }
      });
    return cells;
  }

  const Execution& Run;
  NodeExchange<TSample>& Exchange;
  const Neighborhoods& Known;
  const SplatOptions Options;
};

} // namespace isopoint

#endif
