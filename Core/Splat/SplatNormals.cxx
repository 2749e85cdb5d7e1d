// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SplatNormals.h"

#include <Eigen/Eigenvalues>

#include <optional>

namespace isopoint
{
namespace
{

/// The unoriented normal of the plane through points of size near 1 around the origin, if unique.
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
  // Not computeDirect(): its sines and cosines differ between libraries and processors.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(covariance);
  const Eigen::Vector3d& spreads = solver.eigenvalues(); // ascending
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double length = lengthOf({ normal[0], normal[1], normal[2] });
  constexpr double minQuality = 1e-6;
  const bool isDetermined =
    spreads[1] != 0.0 && 1.0 - spreads[0] / spreads[1] > minQuality && std::isnormal(length);
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
  // Centered and scaled, so that a far origin or a tiny scale costs no digits.
  const Vector& origin = positions[point];
  const double scale = 1.0 / lengthOf(positions[around.back()] - origin);
  std::vector<Eigen::Vector3d> points(1, Eigen::Vector3d::Zero());
  for (const std::size_t other : around)
  {
    const Vector offset = scale * (positions[other] - origin);
    points.emplace_back(offset[0], offset[1], offset[2]);
  }
  return planeNormal(points);
}

/// The mean direction of the surrounding edges that agree with the point's own edge. A single edge
/// may be almost tangential; edges of a sheet close by point to the opposite side.
Vector decreasingSide(
  const SurfacePoints& points, const Vector& own, const std::vector<std::size_t>& around)
{
  Vector mean = own;
  for (const std::size_t point : around)
  {
    const Vector other = directionOf(points.decreasingEdges[point]);
    if (dot(other, own) > 0.0)
    {
      mean += other;
    }
  }
  return mean;
}

} // namespace

Vector planeNormal(
  const SurfacePoints& points, std::size_t point, const std::vector<std::size_t>& around)
{
  const Vector own = directionOf(points.decreasingEdges[point]);
  const std::optional<Vector> normal = fitPlane(points.positions, point, around);
  if (!normal)
  {
    return own;
  }
  return dot(*normal, decreasingSide(points, own, around)) < 0.0 ? -*normal : *normal;
}

} // namespace isopoint
