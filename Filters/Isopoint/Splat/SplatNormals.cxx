// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatNormals.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/linear_least_squares_fitting_3.h>

#include <cmath>

namespace isopoint
{
namespace
{

using Kernel = CGAL::Simple_cartesian<double>;

/// The normal of the plane through points around the origin of a size near 1, unoriented; of
/// length 0 where they do not tell of one.
Vector planeNormal(const std::vector<Kernel::Point_3>& points)
{
  Kernel::Plane_3 plane;
  Kernel::Point_3 centroid;
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

} // namespace

PlaneNormals::PlaneNormals(const NearestPositions& nearest, const std::vector<Vector>& positions,
  const std::vector<Vector>& decreasingEdges, std::size_t neighborCount)
  : Finder(nearest)
  , Positions(positions)
  , DecreasingEdges(decreasingEdges)
  , NeighborCount(neighborCount)
{
}

Vector PlaneNormals::at(std::size_t point)
{
  this->Finder.find(point, this->NeighborCount, this->Nearest);
  const Vector own = directionOf(this->DecreasingEdges[point]);
  const Vector normal = this->fitPlane(point);
  if (lengthOf(normal) == 0.0)
  {
    return own;
  }
  return dot(normal, this->decreasingSide(own)) < 0.0 ? scaled(-1.0, normal) : normal;
}

Vector PlaneNormals::fitPlane(std::size_t point)
{
  if (this->Nearest.size() < 2)
  {
    return { 0.0, 0.0, 0.0 };
  }
  // Around the point and at a size near 1, so that neither a far origin nor a tiny cloud costs
  // the fit its digits.
  const double scale = 1.0 / this->Nearest.back().distance;
  const Vector& origin = this->Positions[point];
  std::vector<Kernel::Point_3> points(1, Kernel::Point_3(0.0, 0.0, 0.0));
  for (const NearestPositions::Neighbor& neighbor : this->Nearest)
  {
    const Vector& other = this->Positions[neighbor.point];
    points.emplace_back((other[0] - origin[0]) * scale, (other[1] - origin[1]) * scale,
      (other[2] - origin[2]) * scale);
  }
  return planeNormal(points);
}

/// The mean direction of the edges around that fall to the same side as the point's own: a
/// single edge may run nearly along the surface, and edges of a sheet close by fall the other
/// way.
Vector PlaneNormals::decreasingSide(const Vector& own) const
{
  Vector sum = own;
  for (const NearestPositions::Neighbor& neighbor : this->Nearest)
  {
    const Vector other = directionOf(this->DecreasingEdges[neighbor.point]);
    if (dot(other, own) > 0.0)
    {
      sum = { sum[0] + other[0], sum[1] + other[1], sum[2] + other[2] };
    }
  }
  return sum;
}

} // namespace isopoint
