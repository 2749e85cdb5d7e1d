// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_CellCutter_h
#define isopoint_CellCutter_h

#include "Core/Base/Vector.h"
#include "Core/Fit/LocalFit.h"
#include "Core/Splat/Curvature.h"
#include "Core/Splat/NearbyPoints.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/SplatBorder.h"
#include "Core/Splat/SplatCell.h"
#include "Core/Splat/TangentCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// Cuts out the cells of points whose normals are known, one at a time. For one thread.
/// @tparam TNeighbors IsopointNeighbors, or another class with a Finder and isAcrossGap()
/// @tparam TExtents see cutAtBorder()
template <class TNeighbors, class TExtents>
class CellCutter
{
public:
  /// @param normals of the tangent planes in which cells are cut
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

  /// @param missed points that the cell is to be cut towards besides those around it
  SplatCell cut(std::size_t point, const std::vector<std::size_t>& missed)
  {
    this->Missed = missed;
    const double unit = unitAt(this->Points, point);
    if (this->States[point] == SplatState::Hidden)
    {
      return { {}, 0, unit, {} };
    }
    TangentCell cell(this->Normals[point], (this->isSmooth(point) ? 4.0 : 2.0) * openReach);
    this->cutOut(point, unit, cell);
    PlaneForm curvature;
    if (this->isSmooth(point))
    {
      const LocalFit& fit = this->Points.fits[point];
      curvature = curvatureOf(cell.frame(), fit.hessian, fit.gradient, unit);
      cutWhereSurfaceTurns(curvature, cell);
    }
    cell.reduceTo(mostCorners);
    SplatCell result{ {}, 0, unit, curvature };
    for (const TangentCell::Corner& corner : cell)
    {
      const bool isPoint = corner.side != TangentCell::limit && corner.side != TangentCell::plane;
      result.corners[result.count++] = { corner.x, corner.y,
        isPoint ? corner.side : SplatCell::none };
    }
    return result;
  }

private:
  /// How far a cell may reach, in spacings, where no point bounds it; twice as far where points do
  /// but no fit determines a smooth surface, and four times where one does, as between samples in
  /// lines.
  static constexpr double openReach = 1.1;

  /// How far a cell may reach that was cut at a border, in spacings.
  static constexpr double borderCellReach = 1.3;

  /// Corners up to here, in spacings, are certain; those beyond are cut off here where samples
  /// contradict them.
  static constexpr double certainReach = 0.8;
  static constexpr double contradictedReach = 0.6;
  static constexpr double contradiction = 0.35;

  /// How far on either side of the surface samples are asked whether it passes between them.
  static constexpr double sideShare = 0.6;

  /// A point is beyond the plane of a crease, or on it if its normal is the plane's, up to this
  /// share of its distance.
  static constexpr double creaseTolerance = 0.1;

  bool isSmooth(std::size_t point) const { return isSmoothAt(this->Points, point); }

  /// The spacing of the samples at a point, or 0 if there are no fits.
  double spacingAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? 0.0 : this->Points.fits[point].spacing;
  }

  /// The creases that a point's fit knows.
  const std::vector<CreasePlane>& creasesAt(std::size_t point) const
  {
    static const std::vector<CreasePlane> none;
    return this->Points.fits.empty() ? none : this->Points.fits[point].creases;
  }

  /// Cuts off what is farther than the surface's radius of curvature.
  static void cutWhereSurfaceTurns(const PlaneForm& form, TangentCell& cell)
  {
    for (const PrincipalDirection& curvature : principalDirections(form))
    {
      const double radius = 1.0 / std::abs(curvature.value);
      if (radius * radius < cell.squaredReach())
      {
        cell.cut(curvature.x, curvature.y, radius, TangentCell::plane);
        cell.cut(-curvature.x, -curvature.y, radius, TangentCell::plane);
      }
    }
  }

  /// Cuts the octagon down to the cell, in the unit of length.
  void cutOut(std::size_t point, double unit, TangentCell& cell)
  {
    for (const CreasePlane& crease : this->creasesAt(point))
    {
      cell.cut(scaled(-1.0, crease.inward), crease.distance / unit, TangentCell::plane);
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

  /// Cuts off corners that the samples there contradict: where the surface has turned away from the
  /// tangent plane, or has ended.
  void cutWhereSamplesDisagree(std::size_t point, TangentCell& cell) const
  {
    if (!this->Extents || this->Points.fits.empty() || !hasScale(this->Points.fits[point]) ||
        this->isBesideCrease())
    {
      return;
    }
    constexpr int mostRounds = 3; // cuts make corners too
    bool isAnyCut = true;
    for (int round = 0; round < mostRounds && isAnyCut; ++round)
    {
      std::vector<std::array<double, 2>> directions;
      bool isConfirmedBefore = this->isConfirmed(point, (cell.end() - 1)->side);
      for (const TangentCell::Corner& corner : cell)
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
        cell.cut(x, y, contradictedReach, TangentCell::plane);
      }
      isAnyCut = !directions.empty();
    }
  }

  /// Whether the surface goes on smoothly to what is beyond a side: no samples need to be asked.
  bool isConfirmed(std::size_t point, std::size_t side) const
  {
    constexpr double leastCosine = 0.9;
    return side != TangentCell::limit && side != TangentCell::plane && this->isSmooth(point) &&
           this->isSmooth(side) && dot(this->Normals[point], this->Normals[side]) > leastCosine;
  }

  /// Whether a point nearby knows a crease: values beyond that are not those of this one's fit.
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

  /// Whether the value of the sample nearest to a corner is not what a point's fit says, by more
  /// than the values change within a share of the spacing, or of its distance.
  bool isContradicted(
    std::size_t point, const TangentFrame& frame, const TangentCell::Corner& corner) const
  {
    const LocalFit& fit = this->Points.fits[point];
    const Vector place =
      sum(sum(this->Points.positions[point], fit.spacing * corner.x, frame.first),
        fit.spacing * corner.y, frame.second);
    constexpr double reach = 2.0; // in spacings
    const auto* const sample = this->Extents->nearestTo(place, reach * fit.spacing);
    if (!sample)
    {
      return false;
    }
    const Vector position = positionOf(*sample);
    const Vector o = difference(position, this->Points.positions[point]);
    const Hessian& h = fit.hessian;
    const double bend = 0.5 * (h[0] * o[0] * o[0] + h[1] * o[1] * o[1] + h[2] * o[2] * o[2]) +
                        h[3] * o[0] * o[1] + h[4] * o[0] * o[2] + h[5] * o[1] * o[2];
    const double error = static_cast<double>(sample->value) - this->Points.isovalue -
                         dot(fit.gradient, o) - (fit.isSmooth ? bend : 0.0);
    const double unit = std::max(fit.spacing, lengthOf(difference(position, place)));
    return std::abs(error) > contradiction * unit * lengthOf(fit.gradient) &&
           !this->isBetweenSides(
             place, scaled(sideShare * unit, this->Normals[point]), reach * fit.spacing);
  }

  /// Whether the samples nearest to two places on either side of one on the surface are below the
  /// isovalue and not below, as they should be: then the surface passes there, however values
  /// change along the normal, as in the steps of an adaptive grid.
  /// @param down to the place on the side where values decrease
  bool isBetweenSides(const Vector& place, const Vector& down, double reach) const
  {
    const auto isBelow = [&](const auto& sample)
    { return static_cast<double>(sample.value) < this->Points.isovalue; };
    const auto* const below = this->Extents->nearestTo(sum(place, 1.0, down), reach);
    if (!below || !isBelow(*below))
    {
      return false;
    }
    const auto* const above = this->Extents->nearestTo(sum(place, -1.0, down), reach);
    return above && !isBelow(*above);
  }

  /// Cuts a cell towards the points in rings around its own that are within twice its reach:
  /// others cut nothing off.
  void cutTowardsRings(std::size_t point, int rings, double unit, TangentCell& cell)
  {
    constexpr double usual = 1.5; // mostly no others are so near
    this->Nearby.find(point, rings, unit, this->Missed);
    this->Nearby.listWithin(std::min(usual * usual, 4.0 * cell.squaredReach()));
    this->cutTowardsNearby(point, unit, cell);
    if (4.0 * cell.squaredReach() > usual * usual)
    {
      this->Nearby.listWithin(4.0 * cell.squaredReach());
      this->cutTowardsNearby(point, unit, cell);
    }
  }

  void cutTowardsNearby(std::size_t point, double unit, TangentCell& cell)
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

  /// Cuts a cell towards another point: halfway, but not on this side of a crease.
  void cutTowards(std::size_t point, const NearbyPoint& other, double unit, TangentCell& cell) const
  {
    const Vector offset = scaled(
      1.0 / unit, difference(this->Points.positions[other.point], this->Points.positions[point]));
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

  /// Whether another point lies beyond one of a point's creases, or on the piece that meets its own
  /// there: nothing is to be cut halfway to it.
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

  /// Cuts the cell of a point at the plane of another, if it lies on a piece that meets that one's
  /// at one of its creases. @returns whether it does
  bool isCutAtCrease(std::size_t point, std::size_t other, const Vector& offset, double unit,
    TangentCell& cell) const
  {
    for (const CreasePlane& crease : this->creasesAt(other))
    {
      const double tolerance = creaseTolerance * lengthOf(offset);
      const Vector outward = scaled(-crease.turn, this->Normals[other]);
      const double height = dot(outward, offset);
      if (this->isOnPiece(point, other, crease) && height > -tolerance &&
          crease.distance / unit - dot(crease.inward, offset) < tolerance)
      {
        cell.cut(outward, std::max(0.0, height), TangentCell::plane);
        return true;
      }
    }
    return false;
  }

  /// Whether a point's normal is rather that of the plane across a crease than that of the point
  /// whose crease this is.
  bool isOnPiece(std::size_t point, std::size_t own, const CreasePlane& across) const
  {
    const Vector& normal = this->Normals[point];
    return std::abs(dot(normal, across.inward)) > std::abs(dot(normal, this->Normals[own]));
  }

  /// Whether the surface bends from a point to another, as a sphere would, so that half the
  /// distance in the tangent plane is the farthest that is nearer to the point: the plane between
  /// the two meets the tangent plane farther off, and a splat up to there sticks out. Other sheets
  /// close by are not what it bends to, nor what lies across an edge.
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

#endif
