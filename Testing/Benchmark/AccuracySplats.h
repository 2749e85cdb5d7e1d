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

/// An ellipse in space, or what a plane leaves of it.
struct Splat
{
  analytic::Vector center;
  analytic::Vector normal; // of length 1
  analytic::Vector axis1;  // half-axes, across the normal
  analytic::Vector axis2;
  /// a, b, c, d, e: of places p, only those with (a, b, c) . (p - center) + d >= 0 belong to it
  std::array<double, 5> clip{};

  double radius() const; // half the major axis

  bool isClippedAt(const analytic::Vector& offset) const; // from the centre

  /// The ends of both axes, or where they meet the clipping plane.
  std::array<analytic::Vector, 4> ends() const;
};

/// An array's tuple of three components.
analytic::Vector tupleOf(vtkDataArray* array, vtkIdType i);

/// The splats of a point cloud with normals and the array "Radius" or the arrays "SplatAxis1" and
/// "SplatAxis2", none where there is neither; clipped as an array "SplatClip" of five components
/// tells.
std::vector<Splat> splatsOf(vtkPolyData* points);

/// Answers which places splats cover.
class Coverage
{
public:
  /// @param leastTolerance how far from its plane a splat covers, at least; more where half its
  /// radius is
  Coverage(const std::vector<Splat>& splats, double leastTolerance);

  /// O(splats around the place)
  bool covers(const analytic::Vector& place) const;

private:
  using Cell = std::array<std::int64_t, 3>;

  /// The splats of about one size, by the cell of their centre; cells are as wide as any of them
  /// reaches.
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
