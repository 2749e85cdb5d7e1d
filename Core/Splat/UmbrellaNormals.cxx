// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/UmbrellaNormals.h"

#include <cmath>

namespace isopoint
{
namespace
{

/// The normal of the umbrella, the triangles between a point and each two consecutive neighbors of
/// its cell, weighted by the root of their areas. Nothing if a side has no neighbor.
std::optional<Vector> umbrellaNormal(
  const std::vector<Vector>& positions, std::size_t point, const VoronoiCell& cell)
{
  Vector normal{};
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const std::size_t a = cell.corners[i].beyond;
    const std::size_t b = cell.after(i).beyond;
    if (!VoronoiCell::isPoint(a) || !VoronoiCell::isPoint(b))
    {
      return std::nullopt;
    }
    const auto offsetOf = [&](std::size_t other)
    { return 1.0 / cell.unit * (positions[other] - positions[point]); };
    const Vector area = cross(offsetOf(a), offsetOf(b));
    const double size = lengthOf(area);
    normal = size > 0.0 ? normal + 1.0 / std::sqrt(size) * area : normal;
  }
  return cell.count >= 3 && std::isnormal(lengthOf(normal)) ? std::optional(directionOf(normal))
                                                            : std::nullopt;
}

} // namespace

std::optional<Vector> turnedNormal(
  const SurfacePoints& points, std::size_t point, const Vector& normal, const VoronoiCell& cell)
{
  constexpr double minCosine = 0.2; // below that, of another sheet
  const double maxCosine = isSmoothAt(points, point) ? 0.95 : 0.99;
  const std::optional<Vector> umbrella = umbrellaNormal(points.positions, point, cell);
  const double cosine = umbrella ? dot(*umbrella, normal) : 1.0;
  return cosine < minCosine || cosine > maxCosine ? std::nullopt
                                                  : std::optional(directionOf(normal + *umbrella));
}

} // namespace isopoint
