// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SplatFans.h"

#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace isopoint
{
namespace
{

bool hasSideTowards(const SplatCell& cell, std::size_t point)
{
  return std::any_of(cell.corners.begin(),
    cell.corners.begin() + static_cast<std::ptrdiff_t>(cell.count),
    [point](const SplatCell::Corner& corner) { return corner.beyond == point; });
}

double squaredDistance(const SplatCell::Corner& corner)
{
  return corner.x * corner.x + corner.y * corner.y;
}

/// The corner that takes the place of a side: where the sides before and after it meet; nothing if
/// that is far away.
std::optional<SplatCell::Corner> replacementOf(const SplatCell& cell, std::size_t side)
{
  constexpr double mostReach = 1.1; // of the distance of the side's farther end
  const SplatCell::Corner& before = cell.corners[(side + cell.count - 1) % cell.count];
  const SplatCell::Corner& begin = cell.corners[side];
  const SplatCell::Corner& end = cell.corners[(side + 1) % cell.count];
  const SplatCell::Corner& after = cell.corners[(side + 2) % cell.count];
  const double ax = begin.x - before.x;
  const double ay = begin.y - before.y;
  const double bx = after.x - end.x;
  const double by = after.y - end.y;
  const double turn = ax * by - ay * bx;
  const double t = ((end.x - begin.x) * by - (end.y - begin.y) * bx) / turn;
  const SplatCell::Corner meeting{ begin.x + t * ax, begin.y + t * ay, end.beyond };
  const double farthest = std::max(squaredDistance(begin), squaredDistance(end));
  if (turn > 0.0 && t >= 0.0 && squaredDistance(meeting) <= mostReach * mostReach * farthest)
  {
    return meeting;
  }
  return std::nullopt;
}

void replace(std::size_t side, const SplatCell::Corner& corner, SplatCell& cell)
{
  cell.corners[(side + 1) % cell.count] = corner;
  std::copy(cell.corners.begin() + static_cast<std::ptrdiff_t>(side) + 1,
    cell.corners.begin() + static_cast<std::ptrdiff_t>(cell.count),
    cell.corners.begin() + static_cast<std::ptrdiff_t>(side));
  --cell.count;
}

/// A point's cell with its sides towards points whose cells have none towards it replaced by the
/// corner where the sides before and after meet or, if that is far away, marked as overlapping. See
/// docs/algorithm.md, section 12.6. O(1)
SplatCell withMutualSides(const RawArray<SplatCell>& cells, std::size_t point)
{
  SplatCell cell = cells[point];
  for (std::size_t side = 0; side < cell.count;)
  {
    const std::size_t beyond = cell.corners[side].beyond;
    if (!SplatCell::isPoint(beyond) || hasSideTowards(cells[beyond], point))
    {
      ++side;
      continue;
    }
    const std::optional<SplatCell::Corner> corner =
      cell.count > 3 ? replacementOf(cell, side) : std::nullopt;
    if (corner)
    {
      replace(side, *corner, cell);
    }
    else
    {
      cell.corners[side++].beyond = SplatCell::overlapping;
    }
  }
  return cell;
}

/// A SplatCell whose corners are lowered from the tangent plane onto the surface.
struct LoweredCell
{
  struct Corner
  {
    Vector position;
    Vector normal;      // of the surface, of length 1
    double distance;    // from the point, in its tangent plane
    std::size_t beyond; // see SplatCell
  };

  std::array<Corner, mostCorners> corners; // counterclockwise
  std::size_t count;
  bool isFirstHere; // see SplatCell
};

/// Lowers the corners of a point's cell onto its paraboloid; see docs/algorithm.md, section 12.6.
/// @param normal of length 1
LoweredCell loweredCell(const SplatCell& cell, const Vector& position, const Vector& normal)
{
  const TangentFrame frame(normal);
  LoweredCell lowered;
  lowered.count = cell.count;
  lowered.isFirstHere = cell.isFirstHere;
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const auto& [x, y, beyond] = cell.corners[i];
    const double slopeX = cell.curvature.xx * x + cell.curvature.xy * y;
    const double slopeY = cell.curvature.xy * x + cell.curvature.yy * y;
    const double height = 0.5 * (slopeX * x + slopeY * y);
    Vector place = sum(position, cell.unit * x, frame.first);
    place = sum(place, cell.unit * y, frame.second);
    place = sum(place, cell.unit * height, normal);
    const Vector upwards = sum(sum(normal, -slopeX, frame.first), -slopeY, frame.second);
    lowered.corners[i] = { place, directionOf(upwards), cell.unit * std::sqrt(x * x + y * y),
      beyond };
  }
  return lowered;
}

/// A corner of a point's cell.
struct CornerOf
{
  std::size_t point;
  std::size_t corner;

  bool operator==(const CornerOf& other) const
  {
    return this->point == other.point && this->corner == other.corner;
  }
};

/// The corners of cells that meet, each once, in the order of the points' numbers.
struct Meeting
{
  std::array<CornerOf, mostMeeting> corners{};
  std::size_t count = 0;
  bool isTooLarge = false;    // then they are not brought together
  bool isOverlapping = false; // so are they not; see SplatCell::overlapping

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

/// Brings the corners of cells together.
class CornerJoiner
{
public:
  CornerJoiner(const SurfacePoints& points, const std::vector<Splat>& splats,
    const RawArray<LoweredCell>& cells)
    : Points(points)
    , Splats(splats)
    , Cells(cells)
  {
  }

  /// A corner where it meets others: at the mean of all, the same for each of them.
  LoweredCell::Corner joined(const CornerOf& corner) const
  {
    Meeting meeting;
    meeting.add(corner, this->Points);
    if (!this->follow(corner, true, meeting))
    {
      this->follow(corner, false, meeting);
    }
    LoweredCell::Corner result = this->at(corner);
    const bool isInside = this->isBetweenPoints(corner);
    if (meeting.isTooLarge || meeting.isOverlapping || (meeting.count < 3 && isInside))
    {
      // Where cells do not agree, those around overlap, so that nothing gapes.
      constexpr double overlap = 0.1;
      const Vector outward = difference(result.position, this->Points.positions[corner.point]);
      result.position = sum(result.position, isInside ? overlap : 0.0, outward);
      return result;
    }
    const Vector& origin = this->at(meeting.corners.front()).position;
    Vector offset{ 0.0, 0.0, 0.0 };
    Vector normal{ 0.0, 0.0, 0.0 };
    for (std::size_t i = 0; i < meeting.count; ++i)
    {
      const LoweredCell::Corner& other = this->at(meeting.corners[i]);
      offset = sum(offset, 1.0, difference(other.position, origin));
      normal = sum(normal, 1.0, other.normal);
    }
    result.position = sum(origin, 1.0 / static_cast<double>(meeting.count), offset);
    result.normal = directionOf(normal);
    return result;
  }

private:
  const LoweredCell::Corner& at(const CornerOf& corner) const
  {
    return this->Cells[corner.point].corners[corner.corner];
  }

  /// What is beyond the side that begins at a corner or, backward, the one that ends there.
  std::size_t beyond(const CornerOf& corner, bool isOnward) const
  {
    const LoweredCell& cell = this->Cells[corner.point];
    const std::size_t before = (corner.corner > 0 ? corner.corner : cell.count) - 1;
    return cell.corners[isOnward ? corner.corner : before].beyond;
  }

  /// Whether both sides at a corner are cuts halfway to other points: the surface goes on there.
  bool isBetweenPoints(const CornerOf& corner) const
  {
    return this->beyond(corner, true) != SplatCell::none &&
           this->beyond(corner, false) != SplatCell::none;
  }

  /// The corner of the cell across a side that is at the same place.
  std::optional<CornerOf> across(const CornerOf& corner, bool isOnward) const
  {
    const std::size_t beyond = this->beyond(corner, isOnward);
    if (!SplatCell::isPoint(beyond))
    {
      return std::nullopt;
    }
    const LoweredCell& other = this->Cells[beyond];
    for (std::size_t i = 0; i < other.count; ++i)
    {
      if (other.corners[i].beyond == corner.point)
      {
        return CornerOf{ beyond, isOnward ? (i + 1) % other.count : i };
      }
    }
    return std::nullopt;
  }

  /// Whether two corners may be one place: the normals of their points do not oppose, and the two
  /// are no farther apart than 1.2 times as far as they are from their points.
  bool areClose(const CornerOf& a, const CornerOf& b) const
  {
    constexpr double mostShare = 1.2;
    const LoweredCell::Corner& atA = this->at(a);
    const LoweredCell::Corner& atB = this->at(b);
    return dot(this->Splats[a.point].normal, this->Splats[b.point].normal) > 0.0 &&
           lengthOf(difference(atA.position, atB.position)) <=
             mostShare * 0.5 * (atA.distance + atB.distance);
  }

  /// Adds the corners that follow the first one, from cell to cell around the place where they
  /// meet.
  /// @returns whether this leads back to it
  bool follow(const CornerOf& first, bool isOnward, Meeting& meeting) const
  {
    CornerOf last = first;
    while (!meeting.isTooLarge)
    {
      const std::optional<CornerOf> next = this->across(last, isOnward);
      if (!next)
      {
        meeting.isOverlapping |= this->beyond(last, isOnward) == SplatCell::overlapping;
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
  const std::vector<Splat>& Splats;
  const RawArray<LoweredCell>& Cells;
};

/// Sets all of a splat but its normal.
void setShape(const CornerJoiner& joiner, std::size_t point, const Vector& position,
  const LoweredCell& cell, Splat& splat)
{
  const TangentFrame frame(splat.normal);
  std::array<Vector, mostCorners> offsets{};
  std::array<Vector, mostCorners> normals{};
  splat.radius = 0.0;
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const LoweredCell::Corner corner = joiner.joined({ point, i });
    offsets[i] = difference(corner.position, position);
    normals[i] = corner.normal;
    splat.radius = std::max(splat.radius, lengthOf(offsets[i]));
  }
  splat.axis = scaled(splat.radius, frame.first);
  splat.corners = {};
  if (!cell.isFirstHere || !(splat.radius > 0.0) || !std::isfinite(splat.radius))
  {
    return;
  }
  constexpr double mostSlope = 10.0;
  for (std::size_t i = 0; i < mostCorners; ++i)
  {
    const Vector& offset = offsets[std::min(i, cell.count - 1)];
    const Vector& normal = normals[std::min(i, cell.count - 1)];
    const double upwards = std::max(dot(normal, splat.normal), 1.0 / mostSlope);
    const auto inRadii = [&](const Vector& direction)
    { return static_cast<float>(dot(offset, direction) / splat.radius); };
    const auto slope = [&](const Vector& direction)
    { return static_cast<float>(dot(normal, direction) / upwards); };
    splat.corners[i] = { inRadii(frame.first), inRadii(frame.second), inRadii(splat.normal),
      slope(frame.first), slope(frame.second) };
  }
}

} // namespace

void shapeSplats(const Execution& execution, const SurfacePoints& points, RawArray<SplatCell> cells,
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
        lowered[i] = loweredCell(withMutualSides(cells, i), points.positions[i], splats[i].normal);
      }
    },
    [&](double share) { execution.progress(0.5 * share); });
  cells = {};
  const CornerJoiner joiner(points, splats, lowered);
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
