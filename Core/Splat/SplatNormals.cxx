// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SplatNormals.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>

namespace isopoint
{
namespace
{

/// The normal, not oriented, of the plane through points around the origin of a size near 1, if
/// they determine one.
std::optional<Vector> planeNormal(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    centroid += point;
  }
  centroid /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d offset = point - centroid;
    covariance += offset * offset.transpose();
  }
  // Not by computeDirect(), whose sines and cosines differ among libraries and processors.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(covariance);
  const Eigen::Vector3d& spreads = solver.eigenvalues(); // ascending
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double length = lengthOf({ normal[0], normal[1], normal[2] });
  constexpr double leastQuality = 1e-6;
  const bool isDetermined =
    spreads[1] != 0.0 && 1.0 - spreads[0] / spreads[1] > leastQuality && std::isnormal(length);
  return isDetermined ? std::optional(directionOf({ normal[0], normal[1], normal[2] }))
                      : std::nullopt;
}

std::optional<Vector> fitPlane(
  const std::vector<Vector>& positions, std::size_t point, const std::vector<std::size_t>& around)
{
  if (around.size() < 2)
  {
    return std::nullopt;
  }
  // Around the point and at a size near 1, so that the fit loses no digits to a far origin or a
  // tiny scale.
  const Vector& origin = positions[point];
  const double scale = 1.0 / lengthOf(difference(positions[around.back()], origin));
  std::vector<Eigen::Vector3d> points(1, Eigen::Vector3d::Zero());
  for (const std::size_t other : around)
  {
    const Vector offset = scaled(scale, difference(positions[other], origin));
    points.emplace_back(offset[0], offset[1], offset[2]);
  }
  return planeNormal(points);
}

/// The mean direction of those edges around along which values decrease to the same side as along
/// the point's own: a single edge may run nearly along the surface, and along the edges of a sheet
/// close by values decrease to the other side.
Vector decreasingSide(
  const SurfacePoints& points, const Vector& own, const std::vector<std::size_t>& around)
{
  Vector mean = own;
  for (const std::size_t point : around)
  {
    const Vector other = directionOf(points.decreasingEdges[point]);
    if (dot(other, own) > 0.0)
    {
      mean = sum(mean, 1.0, other);
    }
  }
  return mean;
}

} // namespace

std::optional<Vector> fieldNormal(const SurfacePoints& points, std::size_t point)
{
  if (points.fits.empty() || !points.fits[point].isGradientFitted)
  {
    return std::nullopt;
  }
  const Vector& gradient = points.fits[point].gradient;
  return std::isnormal(lengthOf(gradient)) // denormal gradients have lost their direction
           ? std::optional(scaled(-1.0, directionOf(gradient)))
           : std::nullopt;
}

Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around)
{
  const Vector own = directionOf(points.decreasingEdges[point]);
  const std::optional<Vector> normal = fitPlane(points.positions, point, around);
  if (!normal)
  {
    return own;
  }
  return dot(*normal, decreasingSide(points, own, around)) < 0.0 ? scaled(-1.0, *normal) : *normal;
}

} // namespace isopoint
