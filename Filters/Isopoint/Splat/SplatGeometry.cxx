// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatGeometry.h"

#include "Isopoint/Splat/NearestPositions.h"
#include "Isopoint/Splat/SplatBorder.h"
#include "Isopoint/Splat/SplatCrease.h"
#include "Isopoint/Splat/SplatNormals.h"
#include "Isopoint/Splat/SplatShape.h"
#include "Isopoint/Splat/TangentCell.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isopoint
{
namespace
{

/// How many of the nearest positions are looked at first when a cell is cut, and at most. Cells of
/// a uniform cloud have about six sides.
constexpr std::size_t firstNeighbors = 20;
constexpr std::size_t mostNeighbors = 160;

/// The distance of this one of the nearest positions tells how dense they are.
constexpr std::size_t densityNeighbors = 12;

/// A splat's size beside its cell's, since the surface bends where the cell is flat: that where it
/// bends little, what is added for the square of the angle it turns by within the cell, and the
/// most, which is also that where no fit tells how it bends.
constexpr double leastOverlap = 1.1;
constexpr double overlapOfBend = 0.5;
constexpr double mostOverlap = 1.2;

/// How far a cell may reach, in spacings of the samples: where other points bound it on all sides;
/// where those do around a gap in a smooth surface; where none do, beside a smooth surface's
/// border; and where no fit tells of a surface either.
constexpr double closedReach = 2.5;
constexpr double gapReach = 4.5;
constexpr double borderReach = 1.2;
constexpr double loneReach = 1.0;

/// Points without a smooth fit do not bound the cell of a point with one if they are nearer, in the
/// same unit: with normals that are but estimates, their own splats may miss what lies beyond.
constexpr double unfittedDistance = 0.5;

/// Errors of fits at creases, in the same unit: planes across one whose distances differ by no more
/// are taken to be the same.
constexpr double agreement = 0.01;

/// Shapes splats whose normals are known, one at a time.
class SplatShaper
{
public:
  SplatShaper(
    const NearestPositions& nearest, const SurfacePoints& points, const std::vector<Splat>& splats)
    : Finder(nearest)
    , Points(points)
    , Splats(splats)
    , Border(points.extents)
  {
  }

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
  /// Of the fit that held, if any.
  FitOrder orderAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? FitOrder::None : this->Points.fits[point].order;
  }

  /// Whether a fit tells that the surface is smooth there.
  bool isSmooth(std::size_t point) const { return this->orderAt(point) >= FitOrder::Quadratic; }

  /// Whether a fit tells of a crease beside it.
  bool isBesideCrease(std::size_t point) const { return this->orderAt(point) == FitOrder::Crease; }

  /// What bounds a cell: any points, or those alone that lie on one smooth surface with it.
  enum class Bound
  {
    AllPoints,
    Sheet
  };

  /// Cuts the cell of a point beside a gap of the isopoints, as between samples that stand in
  /// lines. @returns whether points of its own sheet stand all around the gap, as they do not at a
  /// border; the cell is of no use otherwise
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

  /// As the fits tell, or 0: of a sample alone with another one there is no other measure than
  /// their edge.
  double fitSpacingAt(std::size_t point) const
  {
    return this->Points.fits.empty() ? 0.0 : this->Points.fits[point].spacing;
  }

  /// The spacing of the samples at a point, or that of the points around where these are denser:
  /// the samples' neighbourhood may reach across a void, as it does about thin shells.
  double spacingAt(std::size_t point) const
  {
    const double fitted = this->fitSpacingAt(point);
    const double spacing = fitted > 0.0 ? fitted : 0.5 * lengthOf(this->Points.decreasingEdges[point]);
    if (this->Nearest.size() < densityNeighbors)
    {
      return spacing;
    }
    constexpr double share = 0.8;
    return std::min(spacing, share * this->Nearest[densityNeighbors - 1].distance);
  }

  /// Cuts off what is farther than the radius of the surface's curvature, as a fit tells of it.
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

  /// Cuts a disk down to the cell, listing more of the nearest where it takes them: positions
  /// farther than twice its reach do not touch it.
  void cutOut(std::size_t point, double limit, Bound bound, TangentCell& cell)
  {
    for (;; this->list(point, 2 * this->Wanted))
    {
      cell.reset(limit);
      this->Border.cutWhereKnown(cell);
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

  /// Cuts a cell towards one of the nearest: at its plane if fits at both tell of a crease between
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
    // What is before the crease is not the other's to cover.
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

  /// What clips a splat, by the planes across creases. That of a point whose own fit tells of none
  /// still belongs to one side of a crease close by, of which two others are believed; it ends a
  /// little beyond their planes, since what lies in those is not in its own.
  std::array<double, 5> clipOf(std::size_t point, double error, double limit) const
  {
    const bool isBeside = this->isBesideCrease(point);
    std::array<double, 5> clip = clipAtNearest(this->Creases, isBeside ? 1 : 2, error, limit);
    const bool isClipped = clip != std::array<double, 5>{};
    clip[3] += isClipped && !isBeside ? error : 0.0;
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

  /// Whether no smooth fit held at one of the nearest, close to a point of which it did.
  bool isUnfittedBeside(std::size_t point, const NearestPositions::Neighbor& neighbor) const
  {
    return this->isSmooth(point) && !this->isSmooth(neighbor.point) &&
           neighbor.distance < unfittedDistance * this->fitSpacingAt(point);
  }

  /// Whether fits tell that the planes of two points meet between them at a crease.
  bool meetAtCrease(std::size_t point, std::size_t other, const Vector& offset) const
  {
    return this->orderAt(point) != FitOrder::None && this->isBesideCrease(other) &&
           this->doPlanesMeet(point, other, offset);
  }

  /// Whether the planes of two points meet between them: each point lies on the same side of the
  /// other's plane. Points on both planes tell no side.
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
  const std::vector<Splat>& Splats; // normals at least
  std::vector<NearestPositions::Neighbor> Nearest;
  std::size_t Wanted = 0; // of the nearest; there may be fewer
  SplatBorder Border;
  std::vector<SplatCrease> Creases; // by the distance of the points across
};

/// Takes normals from the fits' gradients. @returns the points that have none
std::vector<std::size_t> takeFieldNormals(
  const SurfacePoints& points, bool fieldNormals, std::vector<Splat>& splats)
{
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const bool isFitted = fieldNormals && !points.fits.empty() && points.fits[i].isGradientFitted;
    const double length = isFitted ? lengthOf(points.fits[i].gradient) : 0.0;
    // Denormal gradients have lost their direction.
    if (std::isfinite(length) && length >= std::numeric_limits<double>::min())
    {
      splats[i].normal = scaled(-1.0, directionOf(points.fits[i].gradient));
    }
    else
    {
      others.push_back(i);
    }
  }
  return others;
}

} // namespace

std::vector<Splat> computeSplats(
  const Execution& execution, const SurfacePoints& points, const SplatOptions& options)
{
  std::vector<Splat> splats(points.positions.size());
  const std::vector<std::size_t> unfitted = takeFieldNormals(points, options.fieldNormals, splats);
  if (unfitted.empty() && !options.shapes)
  {
    execution.progress(1.0);
    return splats;
  }
  const NearestPositions nearest(points.positions);
  throwIfAborted(execution);

  const double normalsShare = options.shapes ? 0.4 : 1.0;
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  forBatches(
    execution, unfitted.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      PlaneNormals planes(nearest, points.positions, points.decreasingEdges,
        static_cast<std::size_t>(options.neighborCount));
      for (std::size_t i = begin; i < end; ++i)
      {
        splats[unfitted[i]].normal = planes.at(unfitted[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare * share); });
  forBatches(
    execution, options.shapes ? splats.size() : 0, batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      SplatShaper shaper(nearest, points, splats);
      for (std::size_t i = begin; i < end; ++i)
      {
        shaper.shape(i, splats[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare + (1.0 - normalsShare) * share); });
  return splats;
}

} // namespace isopoint
