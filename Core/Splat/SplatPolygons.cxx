// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SplatPolygons.h"

#include "Core/Base/Vector.h"
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

/// A VoronoiCell whose corners are projected from the tangent plane onto the surface.
struct LoweredCell
{
  struct Corner
  {
    Vector position;
    Vector normal;      // of the surface, of length 1
    double distance;    // from the point, in the tangent plane
    std::size_t beyond; // see VoronoiCell
    bool overlaps;
  };

  std::array<Corner, maxCorners> corners; // counterclockwise
  std::size_t count;
  double unit;
  PlaneForm curvature; // see VoronoiCell
};

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
    lowered.corners[i] = { place, directionOf(upwards), cell.unit * std::sqrt(x * x + y * y),
      beyond, overlaps };
  }
  return lowered;
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

/// Corners of adjacent cells that meet, in the order of the points' numbers.
struct Meeting
{
  std::array<CornerOf, maxMeeting> corners{};
  std::size_t count = 0;
  bool isTooLarge = false;    // then the corners stay apart
  bool isOverlapping = false; // then too; see VoronoiCell::Corner::overlaps

  void add(const CornerOf& corner, const SurfacePoints& points)
  {
    this->isTooLarge = this->count == this->corners.size();
    if (this->isTooLarge)
    {
      return;
    }
    const auto comesBefore = [&](const CornerOf& a, const CornerOf& b)
    {
      return std::pair(points.numberOf(a.point), a.corner) <
             std::pair(points.numberOf(b.point), b.corner);
    };
    CornerOf* const last = this->corners.data() + this->count++;
    *last = corner;
    std::rotate(std::upper_bound(this->corners.data(), last, corner, comesBefore), last, last + 1);
  }
};

/// Joins the corners of adjacent cells.
class CornerJoiner
{
public:
  CornerJoiner(const SurfacePoints& points, const std::vector<Vector>& planes,
    const RawArray<LoweredCell>& cells)
    : Points(points)
    , Planes(planes)
    , Cells(cells)
  {
  }

  /// A corner, moved to the mean of the corners that it meets, which is the same for all. Counts
  /// it.
  LoweredCell::Corner joined(const CornerOf& corner, SplatCornerCounts& counts) const
  {
    Meeting meeting;
    meeting.add(corner, this->Points);
    if (!this->follow(corner, true, meeting))
    {
      this->follow(corner, false, meeting);
    }
    LoweredCell::Corner result = this->at(corner);
    const bool isInside = this->isBetweenPoints(corner);
    const bool isApart =
      meeting.isTooLarge || meeting.isOverlapping || (meeting.count < 3 && isInside);
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
    const Vector& origin = this->at(meeting.corners.front()).position;
    Vector offset{ 0.0, 0.0, 0.0 };
    Vector normal{ 0.0, 0.0, 0.0 };
    for (std::size_t i = 0; i < meeting.count; ++i)
    {
      const LoweredCell::Corner& other = this->at(meeting.corners[i]);
      offset = offset + (other.position - origin);
      normal += other.normal;
    }
    result.position = origin + 1.0 / static_cast<double>(meeting.count) * offset;
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
      const LoweredCell::Corner& side = this->sideAt(corner, isOnward);
      minCosine = std::min(minCosine, dot(this->Planes[side.beyond], this->Planes[corner.point]));
      if (side.overlaps)
      {
        longest = std::max(
          longest, lengthOf(this->next(corner, isOnward).position - this->at(corner).position));
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
      const LoweredCell::Corner& side = this->sideAt(corner, isOnward);
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

  const LoweredCell::Corner& at(const CornerOf& corner) const
  {
    return this->Cells[corner.point].corners[corner.corner];
  }

  /// The next corner of the same cell or, backward, the previous one.
  const LoweredCell::Corner& next(const CornerOf& corner, bool isOnward) const
  {
    const LoweredCell& cell = this->Cells[corner.point];
    const std::size_t step = isOnward ? 1 : cell.count - 1;
    return cell.corners[(corner.corner + step) % cell.count];
  }

  /// The side that begins at a corner or, backward, ends there.
  const LoweredCell::Corner& sideAt(const CornerOf& corner, bool isOnward) const
  {
    return isOnward ? this->at(corner) : this->next(corner, false);
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
    const std::size_t beyond = this->sideAt(corner, isOnward).beyond;
    if (!VoronoiCell::isPoint(beyond) || this->sideAt(corner, isOnward).overlaps)
    {
      return std::nullopt;
    }
    const LoweredCell& other = this->Cells[beyond];
    const std::size_t side = sideTowards(other, corner.point);
    return side < other.count
             ? std::optional(CornerOf{ beyond, isOnward ? (side + 1) % other.count : side })
             : std::nullopt;
  }

  /// Whether two corners may be joined: the normals of their points do not oppose, and their
  /// distance is at most 1.2 times their mean distance from their points.
  bool areClose(const CornerOf& a, const CornerOf& b) const
  {
    constexpr double maxShare = 1.2;
    const LoweredCell::Corner& atA = this->at(a);
    const LoweredCell::Corner& atB = this->at(b);
    return dot(this->Planes[a.point], this->Planes[b.point]) > 0.0 &&
           lengthOf(atA.position - atB.position) <= maxShare * 0.5 * (atA.distance + atB.distance);
  }

  /// Adds the corners that follow the first one, from cell to cell around their meeting place.
  /// @returns whether the cells close around it
  bool follow(const CornerOf& first, bool isOnward, Meeting& meeting) const
  {
    CornerOf last = first;
    while (!meeting.isTooLarge)
    {
      const std::optional<CornerOf> next = this->across(last, isOnward);
      if (!next)
      {
        meeting.isOverlapping |= this->sideAt(last, isOnward).overlaps;
        return false;
      }
      if (*next == first)
      {
        return true;
      }
      if (!this->areClose(last, *next))
      {
        return false;
      }
      meeting.add(*next, this->Points);
      last = *next;
    }
    return false;
  }

  const SurfacePoints& Points;
  const std::vector<Vector>& Planes;
  const RawArray<LoweredCell>& Cells;
};

/// Sets everything but the normal of a splat.
void setShape(const CornerJoiner& joiner, std::size_t point, const Vector& position,
  const LoweredCell& cell, Splat& splat)
{
  const TangentFrame frame(splat.normal);
  std::array<Vector, maxCorners> offsets{};
  std::array<Vector, maxCorners> normals{};
  splat.radius = 0.0;
  splat.counts = {};
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const LoweredCell::Corner corner = joiner.joined({ point, i }, splat.counts);
    offsets[i] = corner.position - position;
    normals[i] = corner.normal;
    splat.radius = std::max(splat.radius, lengthOf(offsets[i]));
  }
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
    const Vector& offset = offsets[std::min(i, cell.count - 1)];
    const Vector& normal = normals[std::min(i, cell.count - 1)];
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
  constexpr std::size_t batch = 8192;
  constexpr std::size_t grain = 512;
  RawArray<LoweredCell> lowered;
  lowered.resize(cells.size());
  forBatches(
    execution, cells.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        lowered[i] =
          loweredCell(withSharedSides(cells, i), points.positions[i], planes[i], splats[i].normal);
      }
    },
    [&](double share) { execution.progress(0.5 * share); });
  cells = {};
  const CornerJoiner joiner(points, planes, lowered);
  forBatches(
    execution, shaped.size(), batch, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t point = shaped[i];
        setShape(joiner, point, points.positions[point], lowered[point], splats[point]);
      }
    },
    [&](double share) { execution.progress(0.5 + 0.5 * share); });
}

} // namespace isopoint
