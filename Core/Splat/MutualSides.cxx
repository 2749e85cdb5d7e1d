// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/MutualSides.h"

#include "Core/Base/Collected.h"
#include "Core/Base/SortUnique.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

namespace isopoint
{
namespace
{

/// The side of a cell towards a point; the number of its sides if there is none.
std::size_t sideTowards(const SplatCell& cell, std::size_t point)
{
  const SplatCell::Corner* const side = std::find_if(cell.begin(), cell.end(),
    [point](const SplatCell::Corner& corner) { return corner.beyond == point; });
  return static_cast<std::size_t>(side - cell.begin());
}

bool hasSideTowards(const SplatCell& cell, std::size_t point)
{
  return sideTowards(cell, point) < cell.count;
}

double squaredDistance(const SplatCell::Corner& corner)
{
  return corner.x * corner.x + corner.y * corner.y;
}

double squaredLength(const SplatCell& cell, std::size_t side)
{
  const SplatCell::Corner& begin = cell.corners[side];
  const SplatCell::Corner& end = cell.corners[(side + 1) % cell.count];
  const double x = end.x - begin.x;
  const double y = end.y - begin.y;
  return x * x + y * y;
}

/// Where the sides before and after a side meet; nothing if that is far away.
std::optional<SplatCell::Corner> meetingOf(const SplatCell& cell, std::size_t side)
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

/// Whether a cell with as many corners as there can be has a corner between its sides towards two
/// points: a side between these may have been dropped.
bool mayHaveDropped(const SplatCell& cell, std::size_t before, std::size_t after)
{
  const std::size_t side = sideTowards(cell, before);
  return cell.count == mostCorners && side < cell.count &&
         cell.corners[(side + 1) % cell.count].beyond == after;
}

void replace(std::size_t side, const SplatCell::Corner& corner, SplatCell& cell)
{
  cell.corners[(side + 1) % cell.count] = corner;
  std::copy(cell.begin() + side + 1, cell.end(), cell.corners.data() + side);
  --cell.count;
}

/// The middle of a side, as the corner that takes its place.
SplatCell::Corner middleOf(const SplatCell& cell, std::size_t side)
{
  const SplatCell::Corner& begin = cell.corners[side];
  const SplatCell::Corner& end = cell.corners[(side + 1) % cell.count];
  return { 0.5 * (begin.x + end.x), 0.5 * (begin.y + end.y), end.beyond };
}

/// Whether a cell's side for a point is between those for two other points.
bool isBetween(const SplatCell& cell, std::size_t before, std::size_t point, std::size_t after)
{
  const std::size_t side = sideTowards(cell, point);
  return side < cell.count && cell.corners[(side + cell.count - 1) % cell.count].beyond == before &&
         cell.corners[(side + 1) % cell.count].beyond == after;
}

/// Whether the cells before and after a side share one as well, which would cross it: rounding and
/// curvature decide which of the four cells at a common corner meet. All four find the same.
bool isCrossed(const RawArray<SplatCell>& cells, std::size_t point, std::size_t side)
{
  const SplatCell& cell = cells[point];
  const std::size_t beyond = cell.corners[side].beyond;
  const std::size_t before = cell.corners[(side + cell.count - 1) % cell.count].beyond;
  const std::size_t after = cell.corners[(side + 1) % cell.count].beyond;
  return SplatCell::isPoint(beyond) && SplatCell::isPoint(before) && SplatCell::isPoint(after) &&
         isBetween(cells[beyond], after, point, before) &&
         isBetween(cells[before], beyond, after, point) &&
         isBetween(cells[after], point, before, beyond);
}

/// A point's cell without the sides that are crossed.
SplatCell withoutCrossedSides(const RawArray<SplatCell>& cells, std::size_t point)
{
  SplatCell cell = cells[point];
  for (std::size_t side = cell.count; side-- > 0;)
  {
    const std::size_t beyond = cells[point].corners[side].beyond;
    if (cell.count > 3 && isCrossed(cells, point, side))
    {
      const std::size_t left = sideTowards(cell, beyond);
      replace(left, middleOf(cell, left), cell);
    }
  }
  return cell;
}

/// The corner that takes the place of a side; nothing if it stays.
/// @param other the cell of the point beyond the side
std::optional<SplatCell::Corner> replacementOf(
  const SplatCell& cell, std::size_t side, const SplatCell& other)
{
  if (const std::optional<SplatCell::Corner> meeting = meetingOf(cell, side))
  {
    return meeting;
  }
  const std::size_t before = cell.corners[(side + cell.count - 1) % cell.count].beyond;
  const std::size_t after = cell.corners[(side + 1) % cell.count].beyond;
  if (SplatCell::isPoint(before) && SplatCell::isPoint(after) &&
      mayHaveDropped(other, after, before))
  {
    return middleOf(cell, side);
  }
  return std::nullopt;
}

} // namespace

std::vector<MissedPoint> missedPoints(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, const RawArray<SplatCell>& cells)
{
  const auto reachesOver = [&](std::size_t point, std::size_t other)
  {
    const SplatCell& cell = cells[point];
    const TangentFrame frame(planes[point]);
    const Vector offset =
      scaled(1.0 / cell.unit, difference(points.positions[other], points.positions[point]));
    const double a = dot(offset, frame.first);
    const double b = dot(offset, frame.second);
    return std::any_of(cell.begin(), cell.end(),
      [&](const SplatCell::Corner& corner)
      { return a * corner.x + b * corner.y > 0.5 * dot(offset, offset); });
  };
  constexpr std::size_t grain = 4096;
  std::vector<MissedPoint> missed =
    collected<MissedPoint>(execution, { cells.size(), 16 * grain, grain },
      [&](std::size_t begin, std::size_t end, std::vector<MissedPoint>& found)
      {
        for (std::size_t other = begin; other < end; ++other)
        {
          for (const SplatCell::Corner& corner : cells[other])
          {
            const std::size_t point = corner.beyond;
            if (SplatCell::isPoint(point) && !hasSideTowards(cells[point], other) &&
                reachesOver(point, other))
            {
              found.emplace_back(point, other);
            }
          }
        }
      });
  keepUnique(missed);
  return missed;
}

SplatCell withMutualSides(const RawArray<SplatCell>& cells, std::size_t point)
{
  SplatCell cell = withoutCrossedSides(cells, point);
  const auto isMutual = [&](std::size_t side)
  {
    const std::size_t beyond = cell.corners[side].beyond;
    return !SplatCell::isPoint(beyond) || hasSideTowards(cells[beyond], point);
  };
  // The shortest first: the order does not depend on where the corners begin.
  bool isAnyReplaced = true;
  while (isAnyReplaced && cell.count > 3)
  {
    double least = std::numeric_limits<double>::infinity();
    std::size_t shortest = 0;
    std::optional<SplatCell::Corner> replacement;
    for (std::size_t side = 0; side < cell.count; ++side)
    {
      const double length = squaredLength(cell, side);
      if (length < least && !isMutual(side))
      {
        if (const std::optional<SplatCell::Corner> corner =
              replacementOf(cell, side, cells[cell.corners[side].beyond]))
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
    cell.corners[side].overlaps = !isMutual(side);
  }
  return cell;
}

} // namespace isopoint
