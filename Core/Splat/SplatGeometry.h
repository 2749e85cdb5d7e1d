// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/RawArray.h"
#include "Core/Base/Sorting.h"
#include "Core/Extraction/Isosurface.h"
#include "Core/Splat/CellCutter.h"
#include "Core/Splat/HiddenPoints.h"
#include "Core/Splat/SharedSides.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatNormals.h"
#include "Core/Splat/SplatPolygons.h"
#include "Core/Splat/UmbrellaNormals.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace isopoint
{

/// See computeSplats().
template <class TNeighbors, class TExtents, class TOwnedPoints>
class SplatMaker
{
public:
  SplatMaker(const Execution& execution, const SurfacePoints& points, const TNeighbors& neighbors,
    const TExtents* extents, const SplatOptions& options, TOwnedPoints& owned)
    : Run(execution)
    , Points(points)
    , Neighbors(neighbors)
    , Extents(extents)
    , Options(options)
    , Owned(owned)
    , Splats(points.positions.size())
  {
  }

  std::vector<Splat> make()
  {
    this->findNormals();
    if (this->Options.shapes)
    {
      this->findHidden();
      this->cutCells();
      shapeSplats(partOf(this->Run, cellsEnd, 1.0), this->Points, std::move(this->Cells),
        this->CellNormals, this->Owned.shaped(), this->Splats);
    }
    return std::move(this->Splats);
  }

private:
  // Shares of the progress.
  static constexpr double normalsEnd = 0.2;
  static constexpr double cutEnd = 0.7;
  static constexpr double cellsEnd = 0.8;

  /// forEachItem() for some of this rank's points.
  template <class MakeWorker, class Work>
  void forPoints(const Execution& execution, const std::vector<std::size_t>& own,
    const MakeWorker& makeWorker, const Work& work)
  {
    constexpr std::size_t batch = 2048;
    constexpr std::size_t grain = 128;
    this->Owned.forEach(
      execution, { own.size(), batch, grain }, makeWorker,
      [&](auto& worker, std::size_t i) { work(worker, own[i]); },
      [&](double share) { execution.progress(share); });
  }

  void findNormals()
  {
    this->CellNormals.resize(this->Splats.size());
    std::vector<std::size_t> unfitted =
      setFieldNormals(this->Run, this->Points, this->Options.fieldNormals,
        [this](std::size_t point, const Vector& normal) { this->CellNormals[point] = normal; });
    this->Owned.keepOwn(unfitted);
    this->forPoints(
      partOf(this->Run, 0.0, this->Options.shapes ? normalsEnd : 1.0), unfitted,
      [this]() {
        return PlaneNormals<TNeighbors>(this->Neighbors, this->Points, this->Options.neighborCount);
      },
      [this](PlaneNormals<TNeighbors>& normals, std::size_t point)
      { this->CellNormals[point] = normals.at(point); });
    this->Owned.share(this->CellNormals);
    forEachIndex(this->Run, this->Splats.size(),
      [this](std::size_t point) { this->Splats[point].normal = this->CellNormals[point]; });
  }

  void findHidden()
  {
    // A point gets visible in one round, and hides its duplicates in the next. The few that are
    // undecided in the end are drawn.
    constexpr int rounds = 6;
    this->States.assign(this->Splats.size(), SplatState::Undecided);
    std::vector<std::size_t> undecided = this->Owned.own();
    for (int round = 0; round < rounds; ++round)
    {
      const std::vector<SplatState> states = this->States;
      this->forPoints(
        partOf(this->Run, normalsEnd, normalsEnd), undecided,
        [this]()
        { return HiddenPoints<TNeighbors>(this->Neighbors, this->Points, this->CellNormals); },
        [&](HiddenPoints<TNeighbors>& hidden, std::size_t point)
        { this->States[point] = hidden.next(point, states); });
      this->Owned.share(this->States);
      std::vector<std::size_t> left = itemsThat(this->Run, undecided.size(),
        [&](std::size_t i) { return this->States[undecided[i]] == SplatState::Undecided; });
      undecided = chosenOf(this->Run, undecided, left);
    }
  }

  void cutCells()
  {
    this->Cells.resize(this->Splats.size());
    this->cut(partOf(this->Run, normalsEnd, cutEnd), this->Owned.own());
    this->Missed = missedPoints(this->Run, this->Points, this->CellNormals, this->Cells);
    std::vector<std::size_t> missing(this->Missed.size());
    forEachIndex(
      this->Run, missing.size(), [&](std::size_t i) { missing[i] = this->Missed[i].first; });
    missing = sortedUnique(this->Run, missing, this->Splats.size());
    this->Owned.keepOwn(missing);
    this->cut(partOf(this->Run, cutEnd, cutEnd), missing);
    const std::vector<std::size_t> changed = this->correctPlanes();
    this->cut(partOf(this->Run, cutEnd, cellsEnd), changed);
  }

  /// Cuts the cells of some points, and shares all cells.
  void cut(const Execution& execution, const std::vector<std::size_t>& own)
  {
    this->forPoints(
      execution, own,
      [this]()
      {
        return CellCutter<TNeighbors, TExtents>(
          this->Neighbors, this->Points, this->Extents, this->CellNormals, this->States);
      },
      [this](CellCutter<TNeighbors, TExtents>& cutter, std::size_t point)
      { this->Cells[point] = cutter.cut(point, this->missedBy(point)); });
    this->Owned.shareCells(this->Cells);
  }

  std::vector<std::size_t> missedBy(std::size_t point) const
  {
    std::vector<std::size_t> others;
    for (auto next = std::lower_bound(
           this->Missed.begin(), this->Missed.end(), MissedPoint(point, std::size_t{ 0 }));
         next != this->Missed.end() && next->first == point; ++next)
    {
      others.push_back(next->second);
    }
    return others;
  }

  /// Hides stray points, and turns the planes of cells whose normals disagree with the surrounding
  /// points.
  /// @returns this rank's points whose cells must be cut again: those and their neighbors
  std::vector<std::size_t> correctPlanes()
  {
    const std::vector<std::size_t>& own = this->Owned.own();
    std::vector<char> areChanged(this->Splats.size(), 0);
    forEachIndex(this->Run, own.size(),
      [&](std::size_t i)
      {
        const std::size_t point = own[i];
        if (this->isStray(point))
        {
          this->States[point] = SplatState::Hidden;
          areChanged[point] = 1;
        }
        else if (const std::optional<Vector> plane = turnedNormal(
                   this->Points, point, this->Splats[point].normal, this->Cells[point]))
        {
          this->CellNormals[point] = *plane;
          areChanged[point] = 1;
        }
      });
    this->Owned.share(this->States);
    this->Owned.share(this->CellNormals);
    this->Owned.share(areChanged);
    const std::vector<std::size_t> changed = itemsThat(this->Run, own.size(),
      [&](std::size_t i)
      {
        const VoronoiCell& cell = this->Cells[own[i]];
        return areChanged[own[i]] ||
               std::any_of(cell.begin(), cell.end(),
                 [&](const VoronoiCell::Corner& corner)
                 { return VoronoiCell::isPoint(corner.beyond) && areChanged[corner.beyond]; });
      });
    return chosenOf(this->Run, own, changed);
  }

  /// Whether a point is not on the surface around it. Either its edge is long, as across a void,
  /// and no cell beside its own has a side towards it; or the normals all around oppose its normal,
  /// but agree with its edge.
  bool isStray(std::size_t point) const
  {
    constexpr double longEdge = 4.0; // in units; as the strong gap criterion
    const VoronoiCell& cell = this->Cells[point];
    const Vector& edge = this->Points.decreasingEdges[point];
    const auto isAlone = [&](const VoronoiCell::Corner& corner)
    {
      return !VoronoiCell::isPoint(corner.beyond) ||
             sideTowards(this->Cells[corner.beyond], point) == this->Cells[corner.beyond].count;
    };
    const auto isOpposed = [&](const VoronoiCell::Corner& corner)
    {
      return VoronoiCell::isPoint(corner.beyond) &&
             dot(this->Splats[corner.beyond].normal, this->Splats[point].normal) < 0.0 &&
             dot(this->Splats[corner.beyond].normal, edge) > 0.0;
    };
    return cell.count > 0 && (std::all_of(cell.begin(), cell.end(), isOpposed) ||
                               (lengthOf(edge) > longEdge * cell.unit &&
                                 std::all_of(cell.begin(), cell.end(), isAlone)));
  }

  const Execution& Run;
  const SurfacePoints& Points;
  const TNeighbors& Neighbors;
  const TExtents* Extents;
  const SplatOptions& Options;
  TOwnedPoints& Owned;
  std::vector<Splat> Splats;
  // One entry per point; share() and shareCells() fetch those of other ranks.
  std::vector<Vector> CellNormals; // normals of the planes in which cells are cut
  std::vector<SplatState> States;
  RawArray<VoronoiCell> Cells;
  std::vector<MissedPoint> Missed;
};

/// Normals and shapes of splats for the points of one surface; see docs/algorithm.md, section 12.
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder
/// @param points consecutive ones should be close
/// @param extents of the samples, or null for no border; see cutAtBorder()
/// @param owned see WholeSurface
/// @throws std::bad_alloc, Aborted
/// Complexity: O(n), plus a few queries of extents
template <class TNeighbors, class TExtents, class TOwnedPoints>
std::vector<Splat> computeSplats(const Execution& execution, const SurfacePoints& points,
  const TNeighbors& neighbors, const TExtents* extents, const SplatOptions& options,
  TOwnedPoints& owned)
{
  return SplatMaker<TNeighbors, TExtents, TOwnedPoints>(
    execution, points, neighbors, extents, options, owned)
    .make();
}

} // namespace isopoint
