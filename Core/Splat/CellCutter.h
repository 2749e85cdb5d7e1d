// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Splat/Curvature.h"
#include "Core/Splat/NearbyPoints.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatBorder.h"
#include "Core/Splat/TangentPolygon.h"
#include "Core/Splat/VoronoiCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Cuts out the Voronoi cells of points with known normals, in their tangent planes. For one
/// thread.
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder and isAcrossGap()
/// @tparam TExtents see cutAtBorder()
template <class TNeighbors, class TExtents>
class CellCutter
{
public:
  /// @param normals of the tangent planes
  /// @param states of all points
  CellCutter(const TNeighbors& neighbors, const SurfacePoints& points, const TExtents* extents,
    const std::vector<Vector>& normals, const std::vector<SplatState>& states)
    : Neighbors(neighbors)
    , Points(points)
    , Normals(normals)
    , States(states)
    , Nearby(neighbors, points, &states)
    , Extents(extents)
  {
  }

  /// @param missed additional points that the cell is cut towards
  VoronoiCell cut(std::size_t point, const std::vector<std::size_t>& missed)
  {
    this->Missed = missed;
    const double unit = unitAt(this->Points, point);
    if (this->States[point] == SplatState::Hidden)
    {
      return { {}, 0, unit, {} };
    }
    TangentPolygon cell(this->Normals[point], (this->isSmooth(point) ? 4.0 : 2.0) * openReach);
    this->cutOut(point, unit, cell);
    PlaneForm curvature;
    if (this->isSmooth(point))
    {
      const LocalFit& fit = this->Points.fits[point];
      curvature = curvatureOf(cell.frame(), fit.hessian, fit.gradient, unit);
      cutWhereSurfaceTurns(curvature, cell);
    }
    cell.reduceTo(maxCorners);
    VoronoiCell result{ {}, 0, unit, curvature };
    for (const TangentPolygon::Corner& corner : cell)
    {
      const bool isPoint =
        corner.side != TangentPolygon::limit && corner.side != TangentPolygon::plane;
      result.corners[result.count++] = { corner.x, corner.y,
        isPoint ? corner.side : VoronoiCell::none };
    }
    return result;
  }

private:
  /// The greatest reach of an open cell, in spacings. That of a closed cell is twice as large, and
  /// four times at a point with a smooth fit: samples in lines have long cells.
  static constexpr double openReach = 1.1;

  /// How far a cell that was cut at a border may extend, in spacings.
  static constexpr double borderCellReach = 1.3;

  /// Corners farther than `certainReach`, in spacings, are cut off at `contradictedReach` if
  /// samples contradict them.
  static constexpr double certainReach = 0.8;
  static constexpr double contradictedReach = 0.6;
  static constexpr double contradiction = 0.35;

  /// Samples are looked up at this distance on either side of the surface, to see if it passes.
  static constexpr double sideShare = 0.6;

  /// Tolerance for a point beyond a crease plane, or on it, as a share of its distance.
  static constexpr double creaseTolerance = 0.1;

  bool isSmooth(std::size_t point) const { return isSmoothAt(this->Points, point); }

  /// The sample spacing at a point, 0 without fits.
  double spacingAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? 0.0 : this->Points.fits[point].spacing;
  }

  const std::vector<CreasePlane>& creasesAt(std::size_t point) const
  {
    static const std::vector<CreasePlane> none;
    return this->Points.fits.empty() ? none : this->Points.fits[point].creases;
  }

  /// Cuts off everything beyond the surface's radius of curvature.
  static void cutWhereSurfaceTurns(const PlaneForm& form, TangentPolygon& cell)
  {
    for (const PrincipalDirection& curvature : principalDirections(form))
    {
      const double radius = 1.0 / std::abs(curvature.value);
      if (radius * radius < cell.squaredReach())
      {
        cell.cut(curvature.x, curvature.y, radius, TangentPolygon::plane);
        cell.cut(-curvature.x, -curvature.y, radius, TangentPolygon::plane);
      }
    }
  }

  /// Cuts the octagon down to the cell. Lengths are in `unit`.
  void cutOut(std::size_t point, double unit, TangentPolygon& cell)
  {
    for (const CreasePlane& crease : this->creasesAt(point))
    {
      cell.cut(-crease.inward, crease.distance / unit, TangentPolygon::plane);
    }
    this->cutTowardsRings(point, 2, unit, cell);
    if (cell.squaredReach() > largeReach * largeReach)
    {
      this->cutTowardsRings(point, 3, unit, cell);
    }
    const double squaredReach = cell.squaredReach();
    cutAtBorder(
      this->Extents, this->Points.positions[point], this->Normals[point], this->spacingAt(point),
      [&](const auto& sample, double width)
      { return this->Neighbors.isAcrossGap(point, sample, width); },
      cell);
    if (cell.isOpen())
    {
      cell.limitTo(openReach);
    }
    else if (cell.squaredReach() < squaredReach)
    {
      cell.limitTo(borderCellReach);
    }
    if (cell.squaredReach() > certainReach * certainReach)
    {
      this->cutWhereSamplesDisagree(point, cell);
    }
  }

  /// Cuts off corners where samples show that the surface bends away from the plane or ends.
  void cutWhereSamplesDisagree(std::size_t point, TangentPolygon& cell) const
  {
    if (!this->Extents || this->Points.fits.empty() || !hasScale(this->Points.fits[point]) ||
        this->isBesideCrease())
    {
      return;
    }
    constexpr int maxRounds = 3; // cuts create new corners
    bool isAnyCut = true;
    for (int round = 0; round < maxRounds && isAnyCut; ++round)
    {
      std::vector<std::array<double, 2>> directions;
      bool isConfirmedBefore = this->isConfirmed(point, (cell.end() - 1)->side);
      for (const TangentPolygon::Corner& corner : cell)
      {
        const bool isConfirmedHere = this->isConfirmed(point, corner.side);
        const double squaredReach = corner.x * corner.x + corner.y * corner.y;
        if (squaredReach > certainReach * certainReach && !(isConfirmedBefore && isConfirmedHere) &&
            this->isContradicted(point, cell.frame(), corner))
        {
          const double reach = std::sqrt(squaredReach);
          directions.push_back({ corner.x / reach, corner.y / reach });
        }
        isConfirmedBefore = isConfirmedHere;
      }
      for (const auto& [x, y] : directions)
      {
        cell.cut(x, y, contradictedReach, TangentPolygon::plane);
      }
      isAnyCut = !directions.empty();
    }
  }

  /// Whether the surface is smooth across a side, so that samples need not be checked there.
  bool isConfirmed(std::size_t point, std::size_t side) const
  {
    constexpr double minCosine = 0.9;
    return side != TangentPolygon::limit && side != TangentPolygon::plane &&
           this->isSmooth(point) && this->isSmooth(side) &&
           dot(this->Normals[point], this->Normals[side]) > minCosine;
  }

  /// Whether a point nearby has a crease. This point's fit does not describe the values beyond.
  bool isBesideCrease() const
  {
    return std::any_of(this->Nearby.begin(), this->Nearby.end(),
      [this](const NearbyPoint& other) { return !this->creasesAt(other.point).empty(); });
  }

  static bool hasScale(const LocalFit& fit)
  {
    const double slope = lengthOf(fit.gradient);
    return slope > 0.0 && std::isfinite(slope) && fit.spacing > 0.0 && std::isfinite(fit.spacing);
  }

  /// Whether the sample nearest to a corner contradicts the fit: its value differs by too much,
  /// compared with the change over the spacing or over the sample's distance from the corner.
  bool isContradicted(
    std::size_t point, const TangentFrame& frame, const TangentPolygon::Corner& corner) const
  {
    const LocalFit& fit = this->Points.fits[point];
    const Vector place = this->Points.positions[point] + fit.spacing * corner.x * frame.first +
                         fit.spacing * corner.y * frame.second;
    constexpr double reach = 2.0; // in spacings
    const auto* const sample = this->Extents->nearestTo(place, reach * fit.spacing);
    if (!sample)
    {
      return false;
    }
    const Vector position = positionOf(*sample);
    const Vector o = position - this->Points.positions[point];
    const Hessian& h = fit.hessian;
    const double bend = 0.5 * (h[0] * o[0] * o[0] + h[1] * o[1] * o[1] + h[2] * o[2] * o[2]) +
                        h[3] * o[0] * o[1] + h[4] * o[0] * o[2] + h[5] * o[1] * o[2];
    const double error = static_cast<double>(sample->value) - this->Points.isovalue -
                         dot(fit.gradient, o) - (fit.isSmooth ? bend : 0.0);
    const double unit = std::max(fit.spacing, lengthOf(position - place));
    return std::abs(error) > contradiction * unit * lengthOf(fit.gradient) &&
           !this->isBetweenSides(
             place, sideShare * unit * this->Normals[point], reach * fit.spacing);
  }

  /// Whether the samples nearest to two places, on either side of a place on the surface, lie on
  /// the correct sides of the isovalue. Then the surface passes there even if values along the
  /// normal change unevenly, as in the steps of an adaptive grid.
  /// @param down offset to the side of lower values
  bool isBetweenSides(const Vector& place, const Vector& down, double reach) const
  {
    const auto isBelow = [&](const auto& sample)
    { return static_cast<double>(sample.value) < this->Points.isovalue; };
    const auto* const below = this->Extents->nearestTo(place + down, reach);
    if (!below || !isBelow(*below))
    {
      return false;
    }
    const auto* const above = this->Extents->nearestTo(place - down, reach);
    return above && !isBelow(*above);
  }

  /// Cuts a cell towards the points in its rings, up to twice the cell's reach.
  void cutTowardsRings(std::size_t point, int rings, double unit, TangentPolygon& cell)
  {
    constexpr double usual = 1.5; // farther points are rarely needed
    this->Nearby.find(point, rings, unit, this->Missed);
    this->Nearby.listWithin(std::min(usual * usual, 4.0 * cell.squaredReach()));
    this->cutTowardsNearby(point, unit, cell);
    if (4.0 * cell.squaredReach() > usual * usual)
    {
      this->Nearby.listWithin(4.0 * cell.squaredReach());
      this->cutTowardsNearby(point, unit, cell);
    }
  }

  void cutTowardsNearby(std::size_t point, double unit, TangentPolygon& cell)
  {
    for (const NearbyPoint& other : this->Nearby)
    {
      if (other.squaredDistance >= 4.0 * cell.squaredReach())
      {
        break;
      }
      this->cutTowards(point, other, unit, cell);
    }
  }

  /// Cuts a cell halfway to another point, unless that point lies across a crease.
  void cutTowards(
    std::size_t point, const NearbyPoint& other, double unit, TangentPolygon& cell) const
  {
    const Vector offset =
      1.0 / unit * (this->Points.positions[other.point] - this->Points.positions[point]);
    const double a = dot(offset, cell.frame().first);
    const double b = dot(offset, cell.frame().second);
    const double along = std::sqrt(other.squaredDistance * (a * a + b * b));
    if (!(cell.reach(a, b) > 0.5 * along) ||
        this->isBeyondCrease(point, other.point, offset, unit) ||
        this->isCutAtCrease(point, other.point, offset, unit, cell))
    {
      return;
    }
    const double distance =
      this->bendsTowards(point, other.point, offset) ? along : other.squaredDistance;
    cell.cut(a, b, 0.5 * distance, other.point);
  }

  /// Whether another point lies beyond one of this point's creases, or on the piece across one, so
  /// that no halfway cut is made.
  bool isBeyondCrease(std::size_t point, std::size_t other, const Vector& offset, double unit) const
  {
    const std::vector<CreasePlane>& creases = this->creasesAt(point);
    const double tolerance = creases.empty() ? 0.0 : creaseTolerance * lengthOf(offset);
    return std::any_of(creases.begin(), creases.end(),
      [&](const CreasePlane& crease)
      {
        const double height = dot(crease.inward, offset) + crease.distance / unit;
        return height < (this->isOnPiece(other, point, crease) ? tolerance : -tolerance);
      });
  }

  /// Cuts the cell at the other point's plane if the point is on the piece across the other's
  /// crease.
  /// @returns whether it did
  bool isCutAtCrease(std::size_t point, std::size_t other, const Vector& offset, double unit,
    TangentPolygon& cell) const
  {
    for (const CreasePlane& crease : this->creasesAt(other))
    {
      const double tolerance = creaseTolerance * lengthOf(offset);
      const Vector outward = -crease.turn * this->Normals[other];
      const double height = dot(outward, offset);
      if (this->isOnPiece(point, other, crease) && height > -tolerance &&
          crease.distance / unit - dot(crease.inward, offset) < tolerance)
      {
        cell.cut(outward, std::max(0.0, height), TangentPolygon::plane);
        return true;
      }
    }
    return false;
  }

  /// Whether a point is on the far side of another point's crease: its normal is closer to that of
  /// the plane across than the other point's is.
  bool isOnPiece(std::size_t point, std::size_t own, const CreasePlane& across) const
  {
    const Vector& normal = this->Normals[point];
    return std::abs(dot(normal, across.inward)) > std::abs(dot(normal, this->Normals[own]));
  }

  /// Whether the surface bends from one point to the other as a sphere does. The plane halfway then
  /// meets the tangent plane too far off, so that the splat would stick out; the cut is made at
  /// half the distance in the tangent plane. Not for points on other sheets or across an edge.
  bool bendsTowards(std::size_t point, std::size_t other, const Vector& offset) const
  {
    if (!this->Points.fits.empty() && !(this->isSmooth(point) && this->isSmooth(other)))
    {
      return false;
    }
    const Vector& normal = this->Normals[point];
    const Vector& otherNormal = this->Normals[other];
    return dot(normal, otherNormal) > 0.0 && dot(offset, normal) * dot(offset, otherNormal) <= 0.0;
  }

  const TNeighbors& Neighbors;
  const SurfacePoints& Points;
  const std::vector<Vector>& Normals;
  const std::vector<SplatState>& States;
  NearbyPoints<TNeighbors> Nearby;
  std::vector<std::size_t> Missed;
  const TExtents* Extents;
};

} // namespace isopoint
