// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SplatCoverage_h
#define SplatCoverage_h

#include "AnalyticSurface.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

class vtkPolyData;

namespace splatcoverage
{

/// A fan of triangles in space: between its center and each two consecutive corners.
struct Splat
{
  analytic::Vector center;
  analytic::Vector normal;               // of length 1
  std::vector<analytic::Vector> corners; // counterclockwise seen from the tip of the normal

  double radius() const; // the distance of the farthest corner
};

/// The splats of a point cloud with normals and the cell arrays "SplatAxis" and "SplatPolygon" of
/// its vertices, in the order of the points; none without them.
std::vector<Splat> splatsOf(vtkPolyData* points);

/// Determines whether splats cover places.
class Coverage
{
public:
  /// @param leastTolerance a splat covers places up to this distance from its plane, or up to half
  /// its radius if that is more
  Coverage(const std::vector<Splat>& splats, double leastTolerance);

  /// Complexity: linear in the number of splats around the place.
  /// @param normal of the surface there: the place is seen along it
  bool covers(const analytic::Vector& place, const analytic::Vector& normal) const;

private:
  /// Splats of similar size, by the cell of their center. Cells are at least as wide as the
  /// distance up to which these splats cover places.
  struct Level
  {
    double cellSize;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  };

  bool isCoveredBy(
    const Splat& splat, const analytic::Vector& place, const analytic::Vector& normal) const;

  const std::vector<Splat>& Splats;
  double LeastTolerance;
  std::vector<Level> Levels;
};

} // namespace splatcoverage

#endif
