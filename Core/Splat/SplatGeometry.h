// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatGeometry_h
#define isopoint_SplatGeometry_h

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Splat/CellCutter.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatFans.h"
#include "Core/Splat/SplatNormals.h"

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace isopoint
{

/// The points of a surface whose splats are computed, where these are all. SurfaceHalo has the same
/// functions where several ranks share the surface.
class AllPoints
{
public:
  explicit AllPoints(std::size_t count)
    : Indices(count)
  {
    std::iota(this->Indices.begin(), this->Indices.end(), std::size_t{ 0 });
  }

  /// Of the points whose cells are cut on this rank; close ones best after each other.
  const std::vector<std::size_t>& own() const { return this->Indices; }

  /// Of the points whose shapes are made on this rank.
  const std::vector<std::size_t>& shaped() const { return this->Indices; }

  /// Drops what is not this rank's own from a list of points, which are ordered.
  void keepOwn(std::vector<std::size_t>& /*points*/) const {}

  /// See forEachItem(). A point that misses samples of other ranks is begun anew once these have
  /// been fetched: work must not leave anything behind where it throws MissingNode.
  template <class MakeWorker, class Work>
  void forEach(const Execution& execution, const ItemBatches& batches, const MakeWorker& makeWorker,
    const Work& work, const BatchDone& batchDone) const
  {
    forEachItem(execution, batches, makeWorker, work, batchDone);
  }

  /// Sets the normals, or cells, of points that are other ranks' own.
  void shareNormals(std::vector<Splat>& /*splats*/) const {}
  void shareCells(RawArray<SplatCell>& /*cells*/) const {}

private:
  std::vector<std::size_t> Indices;
};

/// Normals and shapes of splats for the points of one surface; see docs/algorithm.md, section 12.
///
/// @param points close ones best after each other
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
/// @param extents of the samples, or null: then no border is known; see cutAtBorder()
/// @param chosen AllPoints, or SurfaceHalo
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), and what the few requests of extents take.
template <class TNeighbors, class TExtents, class TChosen>
std::vector<Splat> computeSplats(const Execution& execution, const SurfacePoints& points,
  const TNeighbors& neighbors, const TExtents* extents, const SplatOptions& options,
  TChosen& chosen)
{
  std::vector<Splat> splats(points.positions.size());
  std::vector<std::size_t> unfitted = setFieldNormals(execution, points, options.fieldNormals,
    [&splats](std::size_t point, const Vector& normal) { splats[point].normal = normal; });
  chosen.keepOwn(unfitted);
  throwIfAborted(execution);
  const double normalsShare = options.shapes ? 0.2 : 1.0;
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  chosen.forEach(
    execution, { unfitted.size(), batch, grain },
    [&]() { return PlaneNormals<TNeighbors>(neighbors, points, options.neighborCount); },
    [&](PlaneNormals<TNeighbors>& normals, std::size_t i)
    { splats[unfitted[i]].normal = normals.at(unfitted[i]); },
    [&](double share) { execution.progress(normalsShare * share); });
  chosen.shareNormals(splats);
  if (!options.shapes)
  {
    return splats;
  }
  constexpr double cellsShare = 0.6;
  RawArray<SplatCell> cells; // those of other ranks' points are set by shareCells()
  cells.resize(splats.size());
  const std::vector<std::size_t>& own = chosen.own();
  chosen.forEach(
    execution, { own.size(), batch, grain },
    [&]() { return CellCutter<TNeighbors, TExtents>(neighbors, points, extents, splats); },
    [&](CellCutter<TNeighbors, TExtents>& cutter, std::size_t i)
    { cells[own[i]] = cutter.cut(own[i]); },
    [&](double share) { execution.progress(normalsShare + cellsShare * share); });
  chosen.shareCells(cells);
  shapeSplats(partOf(execution, normalsShare + cellsShare, 1.0), points, std::move(cells),
    chosen.shaped(), splats);
  return splats;
}

} // namespace isopoint

#endif
