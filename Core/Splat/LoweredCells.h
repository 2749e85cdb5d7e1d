// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/RawArray.h"
#include "Core/Base/Vector.h"
#include "Core/Extraction/SurfacePoints.h"
#include "Core/Splat/Curvature.h"
#include "Core/Splat/Splat.h"
#include "Core/Splat/VoronoiCell.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// A VoronoiCell whose corners are projected from the tangent plane onto the surface.
struct LoweredCell
{
  struct Corner
  {
    Vector position;
    Vector normal;   // of the surface, of length 1
    double distance; // from the point, in the tangent plane
  };
  struct Side // see VoronoiCell
  {
    std::size_t beyond;
    bool overlaps;
  };

  std::array<Corner, maxCorners> corners; // counterclockwise
  std::array<Side, maxCorners> sides;     // that begin there, apart: searches read them alone
  std::size_t count;
  double unit;
  PlaneForm curvature; // see VoronoiCell
};

/// The index of a cell's side towards a point, or cell.count if there is none.
inline std::size_t sideTowards(const LoweredCell& cell, std::size_t point)
{
  std::size_t side = 0;
  while (side < cell.count && cell.sides[side].beyond != point)
  {
    ++side;
  }
  return side;
}

struct CornerOf
{
  std::size_t point;
  std::size_t corner;

  bool operator==(const CornerOf& other) const
  {
    return this->point == other.point && this->corner == other.corner;
  }
};

/// The cells of all points, and how their corners and sides correspond.
class LoweredCells
{
public:
  /// @param planes the normals of the cells' planes
  LoweredCells(const SurfacePoints& points, const std::vector<Vector>& planes,
    const RawArray<LoweredCell>& cells)
    : Points(points)
    , Planes(planes)
    , Cells(cells)
  {
  }

  const LoweredCell::Corner& at(const CornerOf& corner) const
  {
    return this->Cells[corner.point].corners[corner.corner];
  }

  /// The next corner of the same cell or, backward, the previous one.
  CornerOf next(const CornerOf& corner, bool isOnward) const
  {
    const LoweredCell& cell = this->Cells[corner.point];
    return { corner.point,
      isOnward ? cornerAfter(cell, corner.corner) : cornerBefore(cell, corner.corner) };
  }

  /// The side that begins at a corner or, backward, ends there.
  const LoweredCell::Side& sideAt(const CornerOf& corner, bool isOnward) const
  {
    const LoweredCell& cell = this->Cells[corner.point];
    return cell.sides[isOnward ? corner.corner : cornerBefore(cell, corner.corner)];
  }

  /// Whether both sides at a corner have a neighbor beyond: the surface continues there.
  bool isBetweenPoints(const CornerOf& corner) const
  {
    return VoronoiCell::isPoint(this->sideAt(corner, true).beyond) &&
           VoronoiCell::isPoint(this->sideAt(corner, false).beyond);
  }

  /// The corresponding corner of the cell across a shared side.
  std::optional<CornerOf> across(const CornerOf& corner, bool isOnward) const
  {
    const auto& [beyond, overlaps] = this->sideAt(corner, isOnward);
    if (!VoronoiCell::isPoint(beyond) || overlaps)
    {
      return std::nullopt;
    }
    const LoweredCell& other = this->Cells[beyond];
    const std::size_t side = sideTowards(other, corner.point);
    return side < other.count
             ? std::optional(CornerOf{ beyond, isOnward ? cornerAfter(other, side) : side })
             : std::nullopt;
  }

  /// Whether the planes of two points do not oppose each other.
  bool areAlike(std::size_t a, std::size_t b) const
  {
    return dot(this->Planes[a], this->Planes[b]) > 0.0;
  }

  /// Whether the distance of two corners is at most 1.2 times their mean distance from their
  /// points.
  bool areClose(const CornerOf& a, const CornerOf& b) const
  {
    constexpr double maxShare = 1.2;
    const LoweredCell::Corner& atA = this->at(a);
    const LoweredCell::Corner& atB = this->at(b);
    return lengthOf(atA.position - atB.position) <= maxShare * 0.5 * (atA.distance + atB.distance);
  }

  const SurfacePoints& Points;
  const std::vector<Vector>& Planes;
  const RawArray<LoweredCell>& Cells;
};

} // namespace isopoint
