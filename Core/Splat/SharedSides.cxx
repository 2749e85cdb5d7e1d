// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/SharedSides.h"

#include "Core/Base/Sorting.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace isopoint
{
namespace
{

bool hasSideTowards(const VoronoiCell& cell, std::size_t point)
{
  return sideTowards(cell, point) < cell.count;
}

double squaredDistance(const VoronoiCell::Corner& corner)
{
  return corner.x * corner.x + corner.y * corner.y;
}

double squaredLength(const VoronoiCell& cell, std::size_t side)
{
  const VoronoiCell::Corner& begin = cell.corners[side];
  const VoronoiCell::Corner& end = cell.after(side);
  const double x = end.x - begin.x;
  const double y = end.y - begin.y;
  return x * x + y * y;
}

/// The intersection of the sides before and after a side, if it is close.
std::optional<VoronoiCell::Corner> meetingOf(const VoronoiCell& cell, std::size_t side)
{
  constexpr double maxReach = 1.1; // of the distance of the side's farther end
  const VoronoiCell::Corner& before = cell.before(side);
  const VoronoiCell::Corner& begin = cell.corners[side];
  const VoronoiCell::Corner& end = cell.after(side);
  const VoronoiCell::Corner& after = cell.after(cornerAfter(cell, side));
  const double ax = begin.x - before.x;
  const double ay = begin.y - before.y;
  const double bx = after.x - end.x;
  const double by = after.y - end.y;
  const double turn = ax * by - ay * bx;
  const double t = ((end.x - begin.x) * by - (end.y - begin.y) * bx) / turn;
  const VoronoiCell::Corner meeting{ begin.x + t * ax, begin.y + t * ay, end.beyond };
  const double farthest = std::max(squaredDistance(begin), squaredDistance(end));
  if (turn > 0.0 && t >= 0.0 && squaredDistance(meeting) <= maxReach * maxReach * farthest)
  {
    return meeting;
  }
  return std::nullopt;
}

void replace(std::size_t side, const VoronoiCell::Corner& corner, VoronoiCell& cell)
{
  cell.corners[cornerAfter(cell, side)] = corner;
  std::copy(cell.begin() + side + 1, cell.end(), cell.corners.data() + side);
  --cell.count;
}

/// The middle of a side, as the corner that takes its place.
VoronoiCell::Corner middleOf(const VoronoiCell& cell, std::size_t side)
{
  const VoronoiCell::Corner& begin = cell.corners[side];
  const VoronoiCell::Corner& end = cell.after(side);
  return { 0.5 * (begin.x + end.x), 0.5 * (begin.y + end.y), end.beyond };
}

/// Whether a cell's side for a point is between those for two other points.
bool isBetween(const VoronoiCell& cell, std::size_t before, std::size_t point, std::size_t after)
{
  const std::size_t side = sideTowards(cell, point);
  return side < cell.count && cell.before(side).beyond == before &&
         cell.after(side).beyond == after;
}

/// Whether a side crosses another one. Four cells meet nearly in one corner, and rounding and
/// curvature make both diagonal pairs share a side. The test gives the same result in all four.
bool isCrossed(const RawArray<VoronoiCell>& cells, std::size_t point, std::size_t side)
{
  const VoronoiCell& cell = cells[point];
  const std::size_t beyond = cell.corners[side].beyond;
  const std::size_t before = cell.before(side).beyond;
  const std::size_t after = cell.after(side).beyond;
  return VoronoiCell::isPoint(beyond) && VoronoiCell::isPoint(before) &&
         VoronoiCell::isPoint(after) && isBetween(cells[beyond], after, point, before) &&
         isBetween(cells[before], beyond, after, point) &&
         isBetween(cells[after], point, before, beyond);
}

/// A point's cell without the sides that are crossed.
VoronoiCell withoutCrossedSides(const RawArray<VoronoiCell>& cells, std::size_t point)
{
  VoronoiCell cell = cells[point];
  // From the last one on: sides before a replaced one keep their indices.
  for (std::size_t side = cell.count; side-- > 0;)
  {
    if (cell.count > 3 && isCrossed(cells, point, side))
    {
      replace(side, middleOf(cell, side), cell);
    }
  }
  return cell;
}

} // namespace

std::vector<MissedPoint> missedPoints(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, const RawArray<VoronoiCell>& cells)
{
  const auto reachesOver = [&](std::size_t point, std::size_t other)
  {
    const VoronoiCell& cell = cells[point];
    const TangentFrame frame(planes[point]);
    const Vector offset = 1.0 / cell.unit * (points.positions[other] - points.positions[point]);
    const double a = dot(offset, frame.first);
    const double b = dot(offset, frame.second);
    return std::any_of(cell.begin(), cell.end(),
      [&](const VoronoiCell::Corner& corner)
      { return a * corner.x + b * corner.y > 0.5 * dot(offset, offset); });
  };
  const std::vector<MissedPoint> missed = collectedFromEach<MissedPoint>(execution, cells.size(),
    [&](std::size_t other, std::vector<MissedPoint>& found)
    {
      for (const VoronoiCell::Corner& corner : cells[other])
      {
        const std::size_t point = corner.beyond;
        if (VoronoiCell::isPoint(point) && !hasSideTowards(cells[point], other) &&
            reachesOver(point, other))
        {
          found.emplace_back(point, other);
        }
      }
    });
  return sortedUnique(execution, missed, cells.size(),
    [](const MissedPoint& each) { return static_cast<std::uint64_t>(each.first); });
}

VoronoiCell withSharedSides(const RawArray<VoronoiCell>& cells, std::size_t point)
{
  VoronoiCell cell = withoutCrossedSides(cells, point);
  const auto isShared = [&](std::size_t side)
  {
    const std::size_t beyond = cell.corners[side].beyond;
    return !VoronoiCell::isPoint(beyond) || hasSideTowards(cells[beyond], point);
  };
  // Shortest first, so that the result does not depend on the first corner.
  bool isAnyReplaced = true;
  while (isAnyReplaced && cell.count > 3)
  {
    double least = std::numeric_limits<double>::infinity();
    std::size_t shortest = 0;
    std::optional<VoronoiCell::Corner> replacement;
    for (std::size_t side = 0; side < cell.count; ++side)
    {
      const double length = squaredLength(cell, side);
      if (length < least && !isShared(side))
      {
        if (const std::optional<VoronoiCell::Corner> corner = meetingOf(cell, side))
        {
          least = length;
          shortest = side;
          replacement = corner;
        }
      }
    }
    isAnyReplaced = replacement.has_value();
    if (isAnyReplaced)
    {
      replace(shortest, *replacement, cell);
    }
  }
  for (std::size_t side = 0; side < cell.count; ++side)
  {
    cell.corners[side].overlaps = !isShared(side);
  }
  return cell;
}

} // namespace isopoint
