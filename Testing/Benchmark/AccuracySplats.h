// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef AccuracySplats_h
#define AccuracySplats_h

#include "AnalyticSurface.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace accuracy
{

/// An ellipse in space, or the part of it on one side of a clip plane.
struct Splat
{
  analytic::Vector center;
  analytic::Vector normal; // of length 1
  analytic::Vector axis1;  // half-axes, perpendicular to the normal
  analytic::Vector axis2;
  /// a, b, c, d, e: of places p, only those with (a, b, c) . (p - center) + d >= 0 belong to it
  std::array<double, 5> clip{};

  double radius() const; // of the longer half-axis

  bool isClippedAt(const analytic::Vector& offset) const; // from the center

  /// The ends of both axes, or where these meet the clip plane.
  std::array<analytic::Vector, 4> ends() const;
};

/// An array's tuple of three components.
analytic::Vector tupleOf(vtkDataArray* array, vtkIdType i);

/// The splats of a point cloud with normals and the array "Radius" or the arrays "SplatAxis1" and
/// "SplatAxis2", clipped by the planes in the array "SplatClip" if there is one. Empty without
/// normals, or without radii and axes.
std::vector<Splat> splatsOf(vtkPolyData* points);

/// Determines whether splats cover places.
class Coverage
{
public:
  /// @param leastTolerance a splat covers places up to this distance from its plane, or up to half
  /// its radius if that is more
  Coverage(const std::vector<Splat>& splats, double leastTolerance);

  /// Complexity: linear in the number of splats around the place.
  bool covers(const analytic::Vector& place) const;

private:
  /// Splats of similar size, by the cell of their center. Cells are at least as wide as the
  /// distance up to which these splats cover places.
  struct Level
  {
    double cellSize;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  };

  bool isCoveredBy(const Splat& splat, const analytic::Vector& place) const;

  const std::vector<Splat>& Splats;
  double LeastTolerance;
  std::vector<Level> Levels;
};

} // namespace accuracy

#endif
