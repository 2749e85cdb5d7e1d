// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SplatPolygons.h"

#include "Core/Base/Vector.h"
#include "Core/Splat/CellTips.h"
#include "Core/Splat/LoweredCells.h"
#include "Core/Splat/SharedSides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace isopoint
{
namespace
{

/// Projects the corners of a cell onto the point's paraboloid; see docs/algorithm.md, section 12.6.
/// @param plane the normal of the cell's plane
/// @param normal of the splat
LoweredCell loweredCell(
  const VoronoiCell& cell, const Vector& position, const Vector& plane, const Vector& normal)
{
  const TangentFrame frame(plane);
  LoweredCell lowered;
  lowered.count = cell.count;
  lowered.unit = cell.unit;
  lowered.curvature = cell.curvature;
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const auto& [x, y, beyond, overlaps] = cell.corners[i];
    const double slopeX = cell.curvature.xx * x + cell.curvature.xy * y;
    const double slopeY = cell.curvature.xy * x + cell.curvature.yy * y;
    const double height = 0.5 * (slopeX * x + slopeY * y);
    Vector place = position + cell.unit * x * frame.first;
    place += cell.unit * y * frame.second;
    place += cell.unit * height * plane;
    const Vector upwards = normal - slopeX * frame.first - slopeY * frame.second;
    lowered.corners[i] = { place, directionOf(upwards), cell.unit * std::sqrt(x * x + y * y) };
    lowered.sides[i] = { beyond, overlaps };
  }
  return lowered;
}

/// Corners of adjacent cells that meet, in the order of the points' numbers.
class Meeting
{
public:
  void add(const CornerOf& corner, const SurfacePoints& points)
  {
    const bool isOfNewCell = std::none_of(this->begin(), this->end(),
      [&](const CornerOf& other) { return other.point == corner.point; });
    this->CellCount += isOfNewCell ? 1 : 0;
    if (this->isTooLarge() || this->Count == this->Corners.size())
    {
      this->CellCount = maxMeeting + 1;
      return;
    }
    const auto comesBefore = [&](const CornerOf& a, const CornerOf& b)
    {
      return std::pair(points.numberOf(a.point), a.corner) <
             std::pair(points.numberOf(b.point), b.corner);
    };
    CornerOf* const last = this->Corners.data() + this->Count++;
    *last = corner;
    std::rotate(std::upper_bound(this->Corners.data(), last, corner, comesBefore), last, last + 1);
  }

  const CornerOf* begin() const { return this->Corners.data(); }
  const CornerOf* end() const { return this->Corners.data() + this->Count; }
  std::size_t size() const { return this->Count; }
  std::size_t cellCount() const { return this->CellCount; }

  /// Then the corners stay apart.
  bool isTooLarge() const { return this->CellCount > maxMeeting; }

private:
  /// A cell has one corner there, and one more for each side that overlaps others.
  std::array<CornerOf, 3 * maxMeeting> Corners;
  std::size_t Count = 0;
  std::size_t CellCount = 0;
};

/// Joins the corners of adjacent cells.
class CornerJoiner : private LoweredCells
{
public:
  using LoweredCells::LoweredCells;

  /// A corner, moved to the mean of the corners that it meets, which is the same for all. Counts
  /// it.
  LoweredCell::Corner joined(const CornerOf& corner, SplatCornerCounts& counts) const
  {
    Meeting meeting;
    meeting.add(corner, this->Points);
    bool passesOverlap = false;
    const bool isClosed = this->follow(corner, true, meeting, passesOverlap) ||
                          this->follow(corner, false, meeting, passesOverlap);
    LoweredCell::Corner result = this->at(corner);
    const bool isInside = this->isBetweenPoints(corner);
    const bool isApart =
      meeting.isTooLarge() || (passesOverlap && !isClosed) || (meeting.cellCount() < 3 && isInside);
    counts.inner += isInside ? 1 : 0;
    counts.apart += isInside && isApart ? 1 : 0;
    if (isApart)
    {
      // Overlap where cells disagree, so that there is no hole.
      if (isInside)
      {
        const double rise = this->riseToMeanHeight(corner);
        this->moveOutward(corner, result);
        result.position += rise * this->Planes[corner.point];
      }
      return result;
    }
    const Vector& origin = this->at(*meeting.begin()).position;
    Vector offset{ 0.0, 0.0, 0.0 };
    Vector normal{ 0.0, 0.0, 0.0 };
    for (const CornerOf& met : meeting)
    {
      const LoweredCell::Corner& other = this->at(met);
      offset = offset + (other.position - origin);
      normal += other.normal;
    }
    result.position = origin + 1.0 / static_cast<double>(meeting.size()) * offset;
    result.normal = directionOf(normal);
    return result;
  }

private:
  /// By which share of its distance an inner corner moves outward. Larger if the normals of
  /// neighbors differ, or next to a long side that overlaps another cell.
  double overlapAt(const CornerOf& corner) const
  {
    constexpr double least = 0.1;
    constexpr double most = 0.43;
    constexpr double turnShare = 8.0;
    constexpr double sideShare = 0.3;
    double minCosine = 1.0;
    double longest = 0.0; // side that overlaps
    for (const bool isOnward : { true, false })
    {
      const LoweredCell::Side& side = this->sideAt(corner, isOnward);
      minCosine = std::min(minCosine, dot(this->Planes[side.beyond], this->Planes[corner.point]));
      if (side.overlaps)
      {
        longest = std::max(longest,
          lengthOf(this->at(this->next(corner, isOnward)).position - this->at(corner).position));
      }
    }
    return std::min(most,
      least + turnShare * (1.0 - minCosine) + sideShare * longest / this->at(corner).distance);
  }

  /// Moves a corner outward by overlapAt() along the paraboloid of its point. Height grows with the
  /// square of the distance, slope with the distance.
  void moveOutward(const CornerOf& corner, LoweredCell::Corner& moved) const
  {
    constexpr double maxSlope = 0.2;
    const double overlap = this->overlapAt(corner);
    const Vector& plane = this->Planes[corner.point];
    const Vector outward = moved.position - this->Points.positions[corner.point];
    const double most = maxSlope * moved.distance;
    const double height = std::clamp((1.0 + overlap) * dot(outward, plane), -most, most);
    moved.position = moved.position + overlap * outward + overlap * height * plane;
    const double upwards = dot(moved.normal, plane);
    if (upwards > 0.0)
    {
      moved.normal = directionOf((1.0 + overlap) / upwards * moved.normal - overlap * plane);
    }
  }

  /// The distance from a corner, along the plane's normal, to the mean height of the surfaces of
  /// the three points whose cells should meet there.
  double riseToMeanHeight(const CornerOf& corner) const
  {
    constexpr double minCosine = 0.5;
    constexpr double maxRise = 0.5; // of the distance
    const LoweredCell::Corner& from = this->at(corner);
    double sumOfHeights = 0.0;
    for (const bool isOnward : { true, false })
    {
      const LoweredCell::Side& side = this->sideAt(corner, isOnward);
      const double cosine = dot(this->Planes[side.beyond], this->Planes[corner.point]);
      if (cosine > minCosine && !side.overlaps)
      {
        const double height = -this->heightOver(side.beyond, from.position) / cosine;
        const double most = maxRise * from.distance;
        sumOfHeights += std::clamp(height, -most, most);
      }
    }
    return sumOfHeights / 3.0;
  }

  /// The height of a place above the paraboloid of a point.
  double heightOver(std::size_t point, const Vector& place) const
  {
    constexpr double maxSlope = 0.5;
    const LoweredCell& cell = this->Cells[point];
    const TangentFrame frame(this->Planes[point]);
    const Vector offset = place - this->Points.positions[point];
    const double x = dot(offset, frame.first) / cell.unit;
    const double y = dot(offset, frame.second) / cell.unit;
    const double rise =
      0.5 * (cell.curvature.xx * x * x + cell.curvature.yy * y * y) + cell.curvature.xy * x * y;
    const double most = maxSlope * std::sqrt(x * x + y * y);
    return dot(offset, this->Planes[point]) - cell.unit * std::clamp(rise, -most, most);
  }

  /// Adds the corners that follow the first one, from cell to cell around their meeting place. A
  /// side that overlaps another cell is passed: if the cells close around it, it becomes a corner.
  /// @returns whether the cells close
  bool follow(const CornerOf& first, bool isOnward, Meeting& meeting, bool& passesOverlap) const
  {
    CornerOf last = first;
    while (!meeting.isTooLarge())
    {
      const bool overlaps = this->sideAt(last, isOnward).overlaps;
      passesOverlap |= overlaps;
      const std::optional<CornerOf> next =
        overlaps ? std::optional(this->next(last, isOnward)) : this->across(last, isOnward);
      if (next && *next == first)
      {
        return true;
      }
      if (!next ||
          !(overlaps || (this->areClose(last, *next) && this->areAlike(last.point, next->point))))
      {
        return false;
      }
      meeting.add(*next, this->Points);
      last = *next;
    }
    return false;
  }
};

/// Sets everything but the normal of a splat.
void setShape(const CornerJoiner& joiner, std::size_t point, const Vector& position,
  const LoweredCell& cell, Splat& splat)
{
  const TangentFrame frame(splat.normal);
  std::array<Vector, maxCorners> offsets{};
  std::array<Vector, maxCorners> normals{};
  std::size_t count = 0; // of different corners
  splat.radius = 0.0;
  splat.counts = {};
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const LoweredCell::Corner corner = joiner.joined({ point, i }, splat.counts);
    const Vector offset = corner.position - position;
    if (count == 0 || offset != offsets[count - 1])
    {
      offsets[count] = offset;
      normals[count] = corner.normal;
      ++count;
      splat.radius = std::max(splat.radius, lengthOf(offset));
    }
  }
  while (count > 1 && offsets[count - 1] == offsets[0])
  {
    --count;
  }
  splat.radius = count < 3 ? 0.0 : splat.radius; // the splats around it have closed over it
  splat.axis = splat.radius * frame.first;
  splat.corners = {};
  const bool isFiniteShape = std::all_of(
    offsets.begin(), offsets.end(), [](const Vector& offset) { return isFinite(offset); });
  if (!(splat.radius > 0.0) || !std::isfinite(splat.radius) || !isFiniteShape)
  {
    return;
  }
  constexpr double maxSlope = 10.0;
  for (std::size_t i = 0; i < maxCorners; ++i)
  {
    const Vector& offset = offsets[std::min(i, count - 1)];
    const Vector& normal = normals[std::min(i, count - 1)];
    const double upwards = std::max(dot(normal, splat.normal), 1.0 / maxSlope);
    const auto inRadii = [&](const Vector& direction)
    { return static_cast<float>(dot(offset, direction) / splat.radius); };
    const auto slope = [&](const Vector& direction)
    { return static_cast<float>(dot(normal, direction) / upwards); };
    splat.corners[i] = { inRadii(frame.first), inRadii(frame.second), inRadii(splat.normal),
      slope(frame.first), slope(frame.second) };
  }
}

} // namespace

void shapeSplats(const Execution& execution, const SurfacePoints& points,
  RawArray<VoronoiCell> cells, const std::vector<Vector>& planes,
  const std::vector<std::size_t>& shaped, std::vector<Splat>& splats)
{
  RawArray<LoweredCell> lowered;
  lowered.resize(cells.size());
  forEachIndex(
    execution, cells.size(),
    [&](std::size_t i)
    {
      lowered[i] =
        loweredCell(withSharedSides(cells, i), points.positions[i], planes[i], splats[i].normal);
    },
    partOf(execution, 0.0, 0.5).progress);
  cells = {};
  cutOffTips(execution, points, planes, lowered);
  const CornerJoiner joiner(points, planes, lowered);
  forEachIndex(
    execution, shaped.size(),
    [&](std::size_t i)
    {
      const std::size_t point = shaped[i];
      setShape(joiner, point, points.positions[point], lowered[point], splats[point]);
    },
    partOf(execution, 0.5, 1.0).progress);
}

} // namespace isopoint
