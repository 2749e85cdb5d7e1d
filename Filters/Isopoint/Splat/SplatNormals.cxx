// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatNormals.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/linear_least_squares_fitting_3.h>

#include <cmath>
#include <limits>

namespace isopoint
{
namespace
{

using Kernel = CGAL::Simple_cartesian<double>;

/// The normal, not oriented, of the plane through points around the origin of a size near 1, if
/// they determine one.
std::optional<Vector> planeNormal(const std::vector<Kernel::Point_3>& points)
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
    return std::nullopt;
  }
  return directionOf(result);
}

} // namespace

std::vector<std::size_t> setFieldNormals(
  const SurfacePoints& points, const SplatOptions& options, std::vector<Splat>& splats)
{
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < splats.size(); ++i)
  {
    const bool isFitted =
      options.fieldNormals && !points.fits.empty() && points.fits[i].isGradientFitted;
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
  const std::optional<Vector> normal = this->fitPlane(point);
  if (!normal)
  {
    return own;
  }
  return dot(*normal, this->decreasingSide(own)) < 0.0 ? scaled(-1.0, *normal) : *normal;
}

std::optional<Vector> PlaneNormals::fitPlane(std::size_t point) const
{
  if (this->Nearest.size() < 2)
  {
    return std::nullopt;
  }
  // Around the point and at a size near 1, so that the fit loses no digits to a far origin or a
  // tiny scale.
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

/// The mean direction of those edges around along which values decrease to the same side as along
/// the point's own: a single edge may run nearly along the surface, and along the edges of a sheet
/// close by values decrease to the other side.
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
