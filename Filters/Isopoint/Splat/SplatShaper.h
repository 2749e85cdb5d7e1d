// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatShaper_h
#define isopoint_SplatShaper_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Fit/LocalFit.h"
#include "Isopoint/Splat/NearestPositions.h"
#include "Isopoint/Splat/Splat.h"
#include "Isopoint/Splat/SplatBorder.h"
#include "Isopoint/Splat/SplatCrease.h"
#include "Isopoint/Splat/SplatShape.h"
#include "Isopoint/Splat/TangentCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// Determines the shapes of splats whose normals are known, one at a time. For one thread.
/// @tparam TExtents see SplatBorder
template <class TExtents>
class SplatShaper
{
public:
  /// @param splats of which normals are set
  SplatShaper(const NearestPositions& nearest, const SurfacePoints& points, const TExtents* extents,
    const std::vector<Splat>& splats)
    : Finder(nearest)
    , Points(points)
    , Splats(splats)
    , Border(extents)
  {
  }

  /// Sets all of a splat but its normal.
  void shape(std::size_t point, Splat& splat)
  {
    this->list(point, firstNeighbors);
    const double spacing = this->spacingAt(point);
    // A cell is as far from what is across a gap as it may reach into it.
    const double mostReach = this->isSmooth(point) ? gapReach : closedReach;
    const double fitSpacing = this->fitSpacingAt(point);
    this->Border.moveTo(
      this->Points.positions[point], splat.normal, fitSpacing, 2.0 * mostReach * fitSpacing);
    TangentCell cell(splat.normal);
    this->cutOut(point, closedReach * spacing, Bound::AllPoints, cell);
    if (cell.isOpen() && !this->reachesAcrossGap(point, cell))
    {
      const double reach = this->isSmooth(point) ? borderReach : loneReach;
      this->cutOut(point, reach * spacing, Bound::AllPoints, cell);
    }
    const LocalFit none{};
    const LocalFit& fit = this->Points.fits.empty() ? none : this->Points.fits[point];
    const double slope = lengthOf(fit.gradient);
    const std::array<Curvature, 2> curvatures = principalCurvatures(cell, fit.hessian, slope);
    cutWhereSurfaceTurns(curvatures, cell);
    const Ellipse ellipse = fitEllipse(cell, splat.normal, fit.hessian, slope);
    const double overlap = isBendKnown(fit.hessian) ? overlapAt(curvatures, cell) : mostOverlap;
    splat.axis1 = scaled(overlap, ellipse.axis1);
    splat.axis2 = scaled(overlap, ellipse.axis2);
    splat.radius = lengthOf(splat.axis1);
    splat.clip =
      this->clipOf(point, agreement * spacing, std::max(closedReach * spacing, splat.radius));
  }

private:
  /// How many of the nearest positions are considered first when a cell is cut, and at most. Cells
  /// of a uniform cloud have about six sides.
  static constexpr std::size_t firstNeighbors = 20;
  static constexpr std::size_t mostNeighbors = 160;

  /// The distance to this one of the nearest positions measures how dense they are.
  static constexpr std::size_t densityNeighbors = 12;

  /// The ratio of a splat's size to its cell's, since the surface bends where the cell is flat: the
  /// least, the increment for the square of the angle by which the surface turns within the cell,
  /// and the greatest, which also holds where no fit determines the curvature.
  static constexpr double leastOverlap = 1.1;
  static constexpr double overlapOfBend = 0.5;
  static constexpr double mostOverlap = 1.2;

  /// How far a cell may reach, in units of spacingAt() (gapReach: of the samples' spacing): where
  /// other points bound it on all sides; where they do so around a gap in a smooth surface; where
  /// they do not, beside the border of a smooth surface; and the same where no fit determines a
  /// surface.
  static constexpr double closedReach = 2.5;
  static constexpr double gapReach = 4.5;
  static constexpr double borderReach = 1.2;
  static constexpr double loneReach = 1.0;

  /// Nearer than this, in spacings, a point without a smooth fit does not bound the cell of a point
  /// with one: the normal of the former is an estimate, and its splat may miss what lies beyond.
  static constexpr double unfittedDistance = 0.5;

  /// The error of fits at creases, in units of spacingAt(): planes across a crease whose distances
  /// differ by no more are taken to be the same.
  static constexpr double agreement = 0.01;

  /// The order of the fit that held, if any.
  std::optional<FitOrder> orderAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? std::nullopt : this->Points.fits[point].order;
  }

  /// Whether a fit held that describes a smooth surface.
  bool isSmooth(std::size_t point) const { return this->orderAt(point) >= FitOrder::Quadratic; }

  /// Whether a fit found a crease close by.
  bool isBesideCrease(std::size_t point) const { return this->orderAt(point) == FitOrder::Crease; }

  /// What bounds a cell: any points, or only those that lie on one smooth surface with its own.
  enum class Bound
  {
    AllPoints,
    Sheet
  };

  /// Cuts the cell of a point beside a gap between isopoints, as between samples that stand in
  /// lines.
  /// @returns whether points of its own sheet stand all around the gap, as they do not at a border;
  /// otherwise the cell is of no use
  bool reachesAcrossGap(std::size_t point, TangentCell& cell)
  {
    const double reach = gapReach * this->fitSpacingAt(point);
    if (!this->isSmooth(point) || !std::isfinite(reach))
    {
      return false;
    }
    this->cutOut(point, reach, Bound::Sheet, cell);
    if (cell.isOpen())
    {
      return false;
    }
    const bool isRound = cell.isRound();
    this->cutOut(point, reach, Bound::AllPoints, cell);
    return isRound || cell.isRound();
  }

  static double overlapAt(const std::array<Curvature, 2>& curvatures, const TangentCell& cell)
  {
    const double turn = cell.reach() * std::max(curvatures[0].value, curvatures[1].value);
    return std::min(mostOverlap, leastOverlap + overlapOfBend * turn * turn);
  }

  void list(std::size_t point, std::size_t count)
  {
    this->Wanted = count;
    this->Finder.find(point, count, this->Nearest);
  }

  /// The samples' spacing as measured for the fits, or 0 without fits.
  double fitSpacingAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? 0.0 : this->Points.fits[point].spacing;
  }

  /// The spacing of the samples at a point, or that of the points around where these are denser:
  /// the samples' neighbourhood may reach across a void, as it does about thin shells.
  double spacingAt(std::size_t point) const
  {
    const double fitted = this->fitSpacingAt(point);
    const double spacing =
      fitted > 0.0 ? fitted : 0.5 * lengthOf(this->Points.decreasingEdges[point]);
    if (this->Nearest.size() < densityNeighbors)
    {
      return spacing;
    }
    constexpr double share = 0.8;
    return std::min(spacing, share * this->Nearest[densityNeighbors - 1].distance);
  }

  /// Cuts off what is farther than the surface's radius of curvature.
  static void cutWhereSurfaceTurns(const std::array<Curvature, 2>& curvatures, TangentCell& cell)
  {
    for (const Curvature& curvature : curvatures)
    {
      const double radius = 1.0 / curvature.value;
      if (radius < cell.reach())
      {
        cell.cut(curvature.direction, radius);
        cell.cut(scaled(-1.0, curvature.direction), radius);
      }
    }
  }

  /// Cuts a disk down to the cell, listing more of the nearest where needed: positions farther than
  /// twice its reach do not touch it.
  void cutOut(std::size_t point, double limit, Bound bound, TangentCell& cell)
  {
    for (;; this->list(point, 2 * this->Wanted))
    {
      cell.reset(limit);
      this->Border.cutWhereFound(cell);
      this->Creases.clear();
      for (const NearestPositions::Neighbor& neighbor : this->Nearest)
      {
        this->cutTowards(point, neighbor, bound, cell);
      }
      this->Border.cut(cell);
      const bool isComplete =
        this->Nearest.size() < this->Wanted || this->Nearest.back().distance > 2.0 * cell.reach();
      if (isComplete || this->Wanted >= mostNeighbors)
      {
        return;
      }
    }
  }

  /// Cuts a cell towards one of the nearest: at its plane if fits at both found a crease between
  /// them, or else halfway. Keeps the planes across creases.
  void cutTowards(
    std::size_t point, const NearestPositions::Neighbor& neighbor, Bound bound, TangentCell& cell)
  {
    const Vector& normal = this->Splats[point].normal;
    const std::size_t other = neighbor.point;
    const Vector offset = difference(this->Points.positions[other], this->Points.positions[point]);
    // Planes too far off to cut the cell may still cut the splat's rim.
    const bool isAcrossCrease = this->meetAtCrease(point, other, offset);
    if (isAcrossCrease)
    {
      this->Creases.push_back(creaseTowards(offset, normal, this->Splats[other].normal));
    }
    if (isAcrossCrease && this->isBesideCrease(point))
    {
      const SplatCrease& crease = this->Creases.back();
      cell.cut(scaled(-1.0, crease.inward), crease.height);
      return;
    }
    if (neighbor.distance > 2.0 * cell.reach() || this->isAcrossKnownCrease(point, other, offset) ||
        this->isUnfittedBeside(point, neighbor))
    {
      return;
    }
    const Vector outward = scaled(1.0 / neighbor.distance, offset);
    const auto along = [&]() { return sum(outward, -dot(outward, normal), normal); };
    const double half = 0.5 * neighbor.distance;
    // No bisector cut on this side of the crease.
    if (isAcrossCrease && half < this->Creases.back().distance * lengthOf(along()))
    {
      return;
    }
    if (this->bendsTowards(point, other, outward))
    {
      cell.cut(directionOf(along()), half);
    }
    else if (bound == Bound::AllPoints)
    {
      cell.cut(outward, half);
    }
  }

  /// The clipping plane of a splat, from the planes across creases. A point whose own fit found no
  /// crease may still lie on one side of a crease close by, if the planes of two others agree on
  /// it; its splat ends a little beyond their planes, which are not exactly those of its own side.
  std::optional<SplatClip> clipOf(std::size_t point, double error, double limit) const
  {
    const bool isBeside = this->isBesideCrease(point);
    std::optional<SplatClip> clip = clipAtNearest(this->Creases, isBeside ? 1 : 2, error, limit);
    if (clip && !isBeside)
    {
      clip->distance += error;
    }
    return clip;
  }

  /// Whether the surface bends from a point to another in a direction, as a sphere would, so that
  /// half the distance in the tangent plane is the farthest that is nearer to the point: the plane
  /// between the two meets the tangent plane farther off, and a splat up to there sticks out. Other
  /// sheets close by are not what it bends to, nor what lies across an edge.
  bool bendsTowards(std::size_t point, std::size_t other, const Vector& outward) const
  {
    const Vector& normal = this->Splats[point].normal;
    const Vector& otherNormal = this->Splats[other].normal;
    const double height = dot(outward, normal);
    const double squaredCosine = 1.0 - height * height;
    if (!this->Points.fits.empty() && !(this->isSmooth(point) && this->isSmooth(other)))
    {
      return false;
    }
    constexpr double leastSquaredCosine = 0.25; // a turn of 120 degrees
    constexpr double tolerance = 0.5;
    const double turn = 2.0 * squaredCosine - 1.0; // the cosine between normals of a sphere
    return squaredCosine > leastSquaredCosine && height * dot(outward, otherNormal) <= 0.0 &&
           std::abs(dot(normal, otherNormal) - turn) < tolerance;
  }

  /// Whether a smooth fit held at a point but not at one of the nearest very close to it.
  bool isUnfittedBeside(std::size_t point, const NearestPositions::Neighbor& neighbor) const
  {
    return this->isSmooth(point) && !this->isSmooth(neighbor.point) &&
           neighbor.distance < unfittedDistance * this->fitSpacingAt(point);
  }

  /// Whether the planes of two points meet between them at a crease that a fit found.
  bool meetAtCrease(std::size_t point, std::size_t other, const Vector& offset) const
  {
    return this->orderAt(point) && this->isBesideCrease(other) &&
           this->doPlanesMeet(point, other, offset);
  }

  /// Whether the planes of two points meet between them: each point lies on the same side of the
  /// other's plane. Points on both planes lie on no side.
  bool doPlanesMeet(std::size_t point, std::size_t other, const Vector& offset) const
  {
    const Vector& normal = this->Splats[point].normal;
    const Vector& otherNormal = this->Splats[other].normal;
    const auto [lower, upper] = std::minmax({ dot(normal, offset), -dot(otherNormal, offset) });
    const double distance = lengthOf(offset);
    const double tolerance = this->isBesideCrease(point) ? 0.02 * distance : 0.0;
    constexpr double rounding = 1e-6;
    return std::abs(dot(normal, otherNormal)) < mostCreaseCosine &&
           (lower >= -tolerance || upper <= tolerance) &&
           std::max(-lower, upper) > rounding * distance;
  }

  /// Whether a point beside a crease meets there with another that lies farther off in a plane
  /// which has cut its cell already.
  bool isAcrossKnownCrease(std::size_t point, std::size_t other, const Vector& offset) const
  {
    if (this->Creases.empty() || !this->isBesideCrease(point) ||
        !this->doPlanesMeet(point, other, offset))
    {
      return false;
    }
    constexpr double tolerance = 0.05;
    return std::any_of(this->Creases.begin(), this->Creases.end(),
      [&](const SplatCrease& crease)
      {
        return std::abs(dot(offset, crease.inward) + crease.height) <
                 tolerance * lengthOf(offset) &&
               std::abs(dot(this->Splats[other].normal, crease.inward)) > mostCreaseCosine;
      });
  }

  const NearestPositions& Finder;
  const SurfacePoints& Points;
  const std::vector<Splat>& Splats; // of which normals are set
  std::vector<NearestPositions::Neighbor> Nearest;
  std::size_t Wanted = 0; // of the nearest; there may be fewer
  SplatBorder<TExtents> Border;
  std::vector<SplatCrease> Creases; // by the distance of the points across
};

} // namespace isopoint

#endif
