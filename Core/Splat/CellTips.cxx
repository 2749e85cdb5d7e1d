// SPDX-License-Identifier: GPL-3.0-or-later
#include "Core/Splat/CellTips.h"

#include "Core/Base/Lists.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace isopoint
{
namespace
{

struct Tip
{
  CornerOf corner;
  /// Where the cells before and after it end, if they do not get there.
  std::array<std::optional<LoweredCell::Corner>, 2> ends;
};

/// The end of the cell across a side, if that cell ends at a border before it gets to a corner.
std::optional<LoweredCell::Corner> endBefore(
  const LoweredCells& cells, const CornerOf& corner, bool isOnward)
{
  const std::optional<CornerOf> end = cells.across(corner, isOnward);
  if (!end || VoronoiCell::isPoint(cells.sideAt(*end, isOnward).beyond) ||
      cells.areClose(corner, *end) || !cells.areAlike(corner.point, end->point))
  {
    return std::nullopt;
  }
  LoweredCell::Corner result = cells.at(*end);
  result.distance = lengthOf(result.position - cells.Points.positions[corner.point]);
  return result.distance < cells.at(corner).distance ? std::optional(result) : std::nullopt;
}

void cutOff(const Tip& tip, LoweredCell& cell)
{
  if (cell.count == maxCorners)
  {
    return;
  }
  const auto place = static_cast<std::ptrdiff_t>(tip.corner.corner);
  const auto insertCopy = [&](auto& list)
  {
    const auto end = list.begin() + static_cast<std::ptrdiff_t>(cell.count);
    std::copy_backward(list.begin() + place, end, end + 1);
    return list.begin() + place;
  };
  const auto corner = insertCopy(cell.corners);
  insertCopy(cell.sides)[0] = { VoronoiCell::none, false };
  ++cell.count;
  corner[0] = tip.ends[0].value_or(corner[0]);
  corner[1] = tip.ends[1].value_or(corner[1]);
}

} // namespace

void cutOffTips(const Execution& execution, const SurfacePoints& points,
  const std::vector<Vector>& planes, RawArray<LoweredCell>& cells)
{
  const LoweredCells all(points, planes, cells);
  const std::vector<Tip> tips = collectedFromEach<Tip>(execution, cells.size(),
    [&](std::size_t point, std::vector<Tip>& found)
    {
      // The last one first: cutting it off leaves the indices of the others.
      for (std::size_t i = cells[point].count; i-- > 0;)
      {
        const CornerOf corner{ point, i };
        if (all.isBetweenPoints(corner))
        {
          const Tip tip{ corner, { endBefore(all, corner, false), endBefore(all, corner, true) } };
          if (tip.ends[0] || tip.ends[1])
          {
            found.push_back(tip);
          }
        }
      }
    });
  for (const Tip& tip : tips)
  {
    cutOff(tip, cells[tip.corner.point]);
  }
}

} // namespace isopoint
