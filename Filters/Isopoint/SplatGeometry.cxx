// SPDX-License-Identifier: GPL-3.0-or-later
#include "SplatGeometry.h"

#include "SplatShape.h"
#include "TangentCell.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/linear_least_squares_fitting_3.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isopoint
{
namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

/// CGAL's view of indices as points.
struct PointOfIndex
{
  using key_type = std::size_t;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::lvalue_property_map_tag;

  const Point* points = nullptr;

  const Point& operator[](std::size_t index) const { return this->points[index]; }
  friend const Point& get(const PointOfIndex& map, std::size_t index) { return map[index]; }
};

using Traits =
  CGAL::Search_traits_adapter<std::size_t, PointOfIndex, CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
using Tree = Search::Tree;

/// How many of the nearest positions are looked at first when a cell is cut, and at most. Cells of
/// a uniform cloud have about six sides.
constexpr std::size_t firstNeighbors = 20;
constexpr std::size_t mostNeighbors = 160;

/// A splat's size beside its cell's, since the surface bends where the cell is flat.
constexpr double overlap = 1.1;

/// How far a cell may reach, in spacings of the samples, where other points bound it on all
/// sides and where they do not.
constexpr double closedReach = 2.5;
constexpr double openReach = 1.0;

/// The distinct ones among positions, and for each position which one it is.
struct DistinctPositions
{
  std::vector<Point> points;
  std::vector<std::size_t> firstUser; // for each distinct position, a position at it
  std::vector<std::size_t> ofPosition;

  explicit DistinctPositions(const std::vector<Vector>& positions)
    : ofPosition(positions.size())
  {
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b)
      { return positions[a] != positions[b] ? positions[a] < positions[b] : a < b; });
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Vector& position = positions[order[i]];
      if (i == 0 || position != positions[order[i - 1]])
      {
        this->points.emplace_back(position[0], position[1], position[2]);
        this->firstUser.push_back(order[i]);
      }
      this->ofPosition[order[i]] = this->points.size() - 1;
    }
  }
};

/// The normal of the plane through points around the origin of a size near 1, unoriented; of
/// length 0 where they do not tell of one.
Vector planeNormal(const std::vector<Point>& points)
{
  Kernel::Plane_3 plane;
  Point centroid;
  const double quality = CGAL::linear_least_squares_fitting_3(
    points.begin(), points.end(), plane, centroid, CGAL::Dimension_tag<0>());
  const Kernel::Vector_3 normal = plane.orthogonal_vector();
  const Vector result{ normal.x(), normal.y(), normal.z() };
  const double length = lengthOf(result);
  constexpr double leastQuality = 1e-6;
  if (!(quality > leastQuality) || !std::isfinite(length) || length == 0.0)
  {
    return { 0.0, 0.0, 0.0 };
  }
  return directionOf(result);
}

/// Finds the nearest distinct positions.
class NearestSearch
{
public:
  struct Neighbor
  {
    std::size_t index; // among the distinct positions
    double distance;
  };

  NearestSearch(const Tree& tree, const DistinctPositions& distinct)
    : Positions(tree)
    , Distinct(distinct)
  {
  }

  /// Lists that many other positions, by distance, or all there are.
  const std::vector<Neighbor>& find(std::size_t self, std::size_t count)
  {
    const PointOfIndex map{ this->Distinct.points.data() };
    Search search(this->Positions, this->Distinct.points[self], static_cast<unsigned>(count + 1),
      0.0, true, Search::Distance(map));
    this->Found.clear();
    for (const auto& found : search)
    {
      if (found.first != self)
      {
        this->Found.push_back({ found.first, std::sqrt(found.second) });
      }
    }
    return this->Found;
  }

private:
  const Tree& Positions;
  const DistinctPositions& Distinct;
  std::vector<Neighbor> Found;
};

/// Fits normals one at a time; scratch is kept from one to the next.
class NormalFitter
{
public:
  NormalFitter(const Tree& tree, const DistinctPositions& distinct, const SurfacePoints& points,
    const SplatOptions& options)
    : Finder(tree, distinct)
    , Distinct(distinct)
    , FallingEdges(points.fallingEdges)
    , Fits(options.fieldNormals ? &points.fits : nullptr)
    , PlaneNeighbors(static_cast<std::size_t>(options.neighborCount))
  {
  }

  Vector fit(std::size_t point)
  {
    if (this->Fits && !this->Fits->empty() && (*this->Fits)[point].order != FitOrder::None)
    {
      const Vector normal = scaled(-1.0, directionOf((*this->Fits)[point].gradient));
      if (std::isfinite(lengthOf(normal)))
      {
        return normal;
      }
    }
    const std::size_t self = this->Distinct.ofPosition[point];
    this->Nearest = this->Finder.find(self, this->PlaneNeighbors);
    const Vector own = directionOf(this->FallingEdges[point]);
    const Vector normal = this->fitPlane(self);
    if (lengthOf(normal) == 0.0)
    {
      return own;
    }
    return dot(normal, this->fallingSide(own)) < 0.0 ? scaled(-1.0, normal) : normal;
  }

private:
  Vector fitPlane(std::size_t self)
  {
    const std::size_t count = std::min(this->PlaneNeighbors, this->Nearest.size());
    if (count < 2)
    {
      return { 0.0, 0.0, 0.0 };
    }
    // Around the point and at a size near 1, so that neither a far origin nor a tiny cloud costs
    // the fit its digits.
    const double scale = 1.0 / this->Nearest[count - 1].distance;
    const Point& origin = this->Distinct.points[self];
    this->PlanePoints.assign(1, Point(0.0, 0.0, 0.0));
    for (std::size_t i = 0; i < count; ++i)
    {
      const Point& other = this->Distinct.points[this->Nearest[i].index];
      this->PlanePoints.emplace_back((other.x() - origin.x()) * scale,
        (other.y() - origin.y()) * scale, (other.z() - origin.z()) * scale);
    }
    return planeNormal(this->PlanePoints);
  }

  /// The mean direction of the edges around that fall to the same side as the point's own: a
  /// single edge may run nearly along the surface, and edges of a sheet close by fall the other
  /// way.
  Vector fallingSide(const Vector& own) const
  {
    Vector sum = own;
    for (const NearestSearch::Neighbor& neighbor : this->Nearest)
    {
      const Vector other =
        directionOf(this->FallingEdges[this->Distinct.firstUser[neighbor.index]]);
      if (dot(other, own) > 0.0)
      {
        sum = { sum[0] + other[0], sum[1] + other[1], sum[2] + other[2] };
      }
    }
    return sum;
  }

  NearestSearch Finder;
  const DistinctPositions& Distinct;
  const std::vector<Vector>& FallingEdges;
  const std::vector<LocalFit>* Fits;
  const std::size_t PlaneNeighbors;
  std::vector<NearestSearch::Neighbor> Nearest;
  std::vector<Point> PlanePoints;
};

/// Shapes splats whose normals are known, one at a time.
class SplatShaper
{
public:
  SplatShaper(const Tree& tree, const DistinctPositions& distinct, const SurfacePoints& points,
    const std::vector<Splat>& splats)
    : Finder(tree, distinct)
    , Distinct(distinct)
    , Points(points)
    , Splats(splats)
  {
  }

  void shape(std::size_t point, Splat& splat)
  {
    const double spacing = this->spacingAt(point);
    TangentCell cell(splat.normal);
    splat.clip = { 0.0, 0.0, 0.0, 0.0 };
    this->cutOut(point, closedReach * spacing, cell, splat);
    if (cell.isOpen())
    {
      this->cutOut(point, openReach * spacing, cell, splat);
    }
    this->cutWhereSurfaceTurns(point, cell);
    const LocalFit none{};
    const LocalFit& fit = this->Points.fits.empty() ? none : this->Points.fits[point];
    const Ellipse ellipse = fitEllipse(cell, splat.normal, fit.hessian, lengthOf(fit.gradient));
    splat.axis1 = scaled(overlap, ellipse.axis1);
    splat.axis2 = scaled(overlap, ellipse.axis2);
    splat.radius = lengthOf(splat.axis1);
  }

private:
  double spacingAt(std::size_t point) const
  {
    // Of a sample alone with another one there is no other measure than their edge.
    const double fitted = this->Points.fits.empty() ? 0.0 : this->Points.fits[point].spacing;
    return fitted > 0.0 ? fitted : 0.5 * lengthOf(this->Points.fallingEdges[point]);
  }

  /// Cuts off what is farther than the radius of the surface's curvature, as a fit tells of it.
  void cutWhereSurfaceTurns(std::size_t point, TangentCell& cell) const
  {
    if (this->Points.fits.empty())
    {
      return;
    }
    const LocalFit& fit = this->Points.fits[point];
    for (const Curvature& curvature :
      principalCurvatures(cell, fit.hessian, lengthOf(fit.gradient)))
    {
      const double radius = 1.0 / curvature.value;
      if (radius < cell.reach())
      {
        cell.cut(curvature.direction, radius);
        cell.cut(scaled(-1.0, curvature.direction), radius);
      }
    }
  }

  /// Cuts a disk down to the cell: positions farther than twice its reach do not touch it.
  void cutOut(std::size_t point, double limit, TangentCell& cell, Splat& splat)
  {
    const std::size_t self = this->Distinct.ofPosition[point];
    for (std::size_t count = firstNeighbors;; count *= 2)
    {
      cell.reset(limit);
      double nearestCrease = limit;
      const auto& nearest = this->Finder.find(self, count);
      bool isComplete = nearest.size() < count;
      for (const NearestSearch::Neighbor& neighbor : nearest)
      {
        const std::size_t other = this->Distinct.firstUser[neighbor.index];
        const Vector offset =
          difference(this->Points.positions[other], this->Points.positions[point]);
        if (this->meetAtCrease(point, other, offset))
        {
          this->cutAtCrease(point, other, offset, cell, splat, nearestCrease);
        }
        else if (neighbor.distance <= 2.0 * cell.reach())
        {
          const Vector outward = scaled(1.0 / neighbor.distance, offset);
          cell.cut(this->bendsTowards(point, other, outward)
                     ? directionOf(sum(outward, -dot(outward, splat.normal), splat.normal))
                     : outward,
            0.5 * neighbor.distance);
        }
        else
        {
          isComplete = true; // but creases a little farther off may cut the splat's rim
        }
      }
      if (isComplete || count >= mostNeighbors)
      {
        return;
      }
    }
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
    const auto isSmooth = [this](std::size_t index)
    {
      const FitOrder order = this->Points.fits[index].order;
      return order == FitOrder::Quadratic || order == FitOrder::Cubic;
    };
    if (!this->Points.fits.empty() && !(isSmooth(point) && isSmooth(other)))
    {
      return false;
    }
    constexpr double leastSquaredCosine = 0.25; // a turn of 120 degrees
    constexpr double tolerance = 0.5;
    const double turn = 2.0 * squaredCosine - 1.0; // the cosine between normals of a sphere
    return squaredCosine > leastSquaredCosine && height * dot(outward, otherNormal) <= 0.0 &&
           std::abs(dot(normal, otherNormal) - turn) < tolerance;
  }

  /// Whether fits tell that the planes of two points meet between them at a crease: each lies on
  /// the same side of the other's.
  bool meetAtCrease(std::size_t point, std::size_t other, const Vector& offset) const
  {
    if (this->Points.fits.empty())
    {
      return false;
    }
    const FitOrder order = this->Points.fits[point].order;
    const FitOrder otherOrder = this->Points.fits[other].order;
    const bool isTold = order != FitOrder::None && otherOrder != FitOrder::None &&
                        (order == FitOrder::Crease || otherOrder == FitOrder::Crease);
    const Vector& normal = this->Splats[point].normal;
    const Vector& otherNormal = this->Splats[other].normal;
    const double height = dot(normal, offset);
    const double otherHeight = -dot(otherNormal, offset);
    const double tolerance = 0.02 * lengthOf(offset);
    return isTold && std::abs(dot(normal, otherNormal)) < mostCreaseCosine &&
           (height < tolerance) == (otherHeight < tolerance);
  }

  /// Cuts off what lies beyond the plane of a point across a crease.
  void cutAtCrease(std::size_t point, std::size_t other, const Vector& offset, TangentCell& cell,
    Splat& splat, double& nearestCrease) const
  {
    const Vector& otherNormal = this->Splats[other].normal;
    const double cosine = dot(splat.normal, otherNormal);
    // At a convex crease each point lies behind the other's plane, at a concave one before it.
    const double height = dot(splat.normal, offset);
    const double otherHeight = -dot(otherNormal, offset);
    const double side =
      (std::abs(height) > std::abs(otherHeight) ? height : otherHeight) < 0.0 ? 1.0 : -1.0;
    const double inside = std::max(0.0, -side * otherHeight);
    cell.cut(scaled(side, otherNormal), inside);
    const double distance = inside / std::sqrt(1.0 - cosine * cosine);
    if (distance < nearestCrease)
    {
      nearestCrease = distance;
      splat.clip = { -side * otherNormal[0], -side * otherNormal[1], -side * otherNormal[2],
        inside };
    }
  }

  NearestSearch Finder;
  const DistinctPositions& Distinct;
  const SurfacePoints& Points;
  const std::vector<Splat>& Splats; // normals at least
};

} // namespace

std::vector<Splat> computeSplats(
  const Execution& execution, const SurfacePoints& points, const SplatOptions& options)
{
  std::vector<Splat> splats(points.positions.size());
  if (points.positions.empty())
  {
    return splats; // CGAL's tree takes no empty set
  }
  const DistinctPositions distinct(points.positions);
  std::vector<std::size_t> indices(distinct.points.size());
  std::iota(indices.begin(), indices.end(), std::size_t{ 0 });
  Tree tree(indices.begin(), indices.end(), Tree::Splitter(),
    Traits(PointOfIndex{ distinct.points.data() }));
  tree.build();
  throwIfAborted(execution);

  constexpr double normalsShare = 0.4;
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  forBatches(
    execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      NormalFitter fitter(tree, distinct, points, options);
      for (std::size_t i = begin; i < end; ++i)
      {
        splats[i].normal = fitter.fit(i);
      }
    },
    [&](double share) { execution.progress(normalsShare * share); });
  forBatches(
    execution, splats.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      SplatShaper shaper(tree, distinct, points, splats);
      for (std::size_t i = begin; i < end; ++i)
      {
        shaper.shape(i, splats[i]);
      }
    },
    [&](double share) { execution.progress(normalsShare + (1.0 - normalsShare) * share); });
  return splats;
}

} // namespace isopoint
