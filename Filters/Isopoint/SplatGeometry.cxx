// SPDX-License-Identifier: GPL-3.0-or-later
#include "SplatGeometry.h"

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

/// The neighbour whose distance is the radius. On a sphere in a uniform cloud the 6th would leave
/// 0.2 % of the surface uncovered and the 10th a few of four million places; of the 12th, which is
/// 1.5 sample spacings away on average, none was found.
constexpr std::size_t radiusNeighbor = 12;

/// The share of the edges around a point that its splat reaches at least: where samples stand
/// closer in one direction than in another, the nearest isopoints may all lie in one row, and the
/// next row is about an edge away.
constexpr double edgeShare = 0.75;

double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double lengthOf(const Vector& a)
{
  return std::hypot(a[0], a[1], a[2]);
}

/// @returns the vector at length 1, or the x axis for one without direction
Vector directionOf(const Vector& a)
{
  const double length = lengthOf(a);
  return length > 0.0 ? Vector{ a[0] / length, a[1] / length, a[2] / length }
                      : Vector{ 1.0, 0.0, 0.0 };
}

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

/// Fits splats one at a time; scratch is kept from one to the next.
class SplatFitter
{
public:
  SplatFitter(const Tree& tree, const DistinctPositions& distinct,
    const std::vector<Vector>& fallingEdges, int neighborCount)
    : Positions(tree)
    , Distinct(distinct)
    , FallingEdges(fallingEdges)
    , PlaneNeighbors(static_cast<std::size_t>(neighborCount))
  {
  }

  Splat fit(std::size_t point)
  {
    const std::size_t self = this->Distinct.ofPosition[point];
    this->findNearest(self);
    const Vector own = directionOf(this->FallingEdges[point]);
    if (this->Nearest.empty())
    {
      return { own, 0.5 * lengthOf(this->FallingEdges[point]) };
    }
    const std::size_t last = std::min(radiusNeighbor, this->Nearest.size()) - 1;
    const double radius =
      std::max(this->Nearest[last].distance, edgeShare * this->middleEdgeLength());
    Vector normal = this->fitPlane(self);
    if (lengthOf(normal) == 0.0)
    {
      return { own, radius };
    }
    if (dot(normal, this->fallingSide(own)) < 0.0)
    {
      normal = { -normal[0], -normal[1], -normal[2] };
    }
    return { normal, radius };
  }

private:
  struct Neighbor
  {
    std::size_t index; // among the distinct positions
    double distance;
  };

  /// Lists the nearest other positions, by distance.
  void findNearest(std::size_t self)
  {
    const std::size_t count = std::max(this->PlaneNeighbors, radiusNeighbor) + 1;
    const PointOfIndex map{ this->Distinct.points.data() };
    Search search(this->Positions, this->Distinct.points[self], static_cast<unsigned>(count), 0.0,
      true, Search::Distance(map));
    this->Nearest.clear();
    for (const auto& found : search)
    {
      if (found.first != self)
      {
        this->Nearest.push_back({ found.first, std::sqrt(found.second) });
      }
    }
  }

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

  /// The median length of the edges of the nearest positions.
  double middleEdgeLength()
  {
    this->EdgeLengths.clear();
    for (const Neighbor& neighbor : this->Nearest)
    {
      this->EdgeLengths.push_back(
        lengthOf(this->FallingEdges[this->Distinct.firstUser[neighbor.index]]));
    }
    const auto middle =
      this->EdgeLengths.begin() + static_cast<std::ptrdiff_t>(this->EdgeLengths.size() / 2);
    std::nth_element(this->EdgeLengths.begin(), middle, this->EdgeLengths.end());
    return *middle;
  }

  /// The mean direction of the edges around that fall to the same side as the point's own: a
  /// single edge may run nearly along the surface, and edges of a sheet close by fall the other
  /// way.
  Vector fallingSide(const Vector& own) const
  {
    Vector sum = own;
    for (const Neighbor& neighbor : this->Nearest)
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

  const Tree& Positions;
  const DistinctPositions& Distinct;
  const std::vector<Vector>& FallingEdges;
  const std::size_t PlaneNeighbors;
  std::vector<Neighbor> Nearest;
  std::vector<Point> PlanePoints;
  std::vector<double> EdgeLengths;
};

} // namespace

std::vector<Splat> computeSplats(const Execution& execution, const std::vector<Vector>& positions,
  const std::vector<Vector>& fallingEdges, int neighborCount)
{
  std::vector<Splat> splats(positions.size());
  if (positions.empty())
  {
    return splats; // CGAL's tree takes no empty set
  }
  const DistinctPositions distinct(positions);
  std::vector<std::size_t> indices(distinct.points.size());
  std::iota(indices.begin(), indices.end(), std::size_t{ 0 });
  Tree tree(indices.begin(), indices.end(), Tree::Splitter(),
    Traits(PointOfIndex{ distinct.points.data() }));
  tree.build();
  throwIfAborted(execution);

  constexpr std::size_t grain = 512;
  const std::size_t batch = 8192 * execution.threads;
  for (std::size_t done = 0; done < positions.size(); done += batch)
  {
    forRanges(execution, std::min(batch, positions.size() - done), grain,
      [&](std::size_t begin, std::size_t end)
      {
        SplatFitter fitter(tree, distinct, fallingEdges, neighborCount);
        for (std::size_t i = done + begin; i < done + end; ++i)
        {
          splats[i] = fitter.fit(i);
        }
      });
    throwIfAborted(execution);
    execution.progress(
      std::min(1.0, static_cast<double>(done + batch) / static_cast<double>(positions.size())));
  }
  return splats;
}

} // namespace isopoint
