// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatBorder.h"

#include <cmath>

namespace isopoint
{
namespace
{

/// How far out of the samples a cell may reach, in spacings of theirs.
constexpr double outerReach = 0.9;

} // namespace

void SplatBorder::moveTo(const Vector& place, const Vector& normal, double spacing, double reach)
{
  this->Place = place;
  this->Normal = normal;
  this->Outer = outerReach * spacing;
  this->Reach = reach;
  this->IsAsked = this->Extents && spacing > 0.0 && std::isfinite(reach);
  const std::array<Vector, extentCount> directions = extentDirections(normal);
  for (std::size_t i = 0; i < extentCount; ++i)
  {
    this->Ways[i] = { directions[i], 0.0, false };
  }
}

void SplatBorder::cutWhereKnown(TangentCell& cell) const
{
  for (const Way& way : this->Ways)
  {
    if (way.isEnd)
    {
      cell.cut(way.direction, way.extent + this->Outer, true);
    }
  }
}

void SplatBorder::cut(TangentCell& cell)
{
  if (!this->IsAsked)
  {
    return;
  }
  for (Way& way : this->Ways)
  {
    const double wanted = cell.reachTowards(way.direction) - this->Outer;
    if (wanted > way.extent && !way.isEnd)
    {
      way.extent = this->Extents({ this->Place, this->Normal, way.direction, wanted, this->Reach });
      way.isEnd = way.extent < wanted;
    }
    if (way.isEnd)
    {
      cell.cut(way.direction, way.extent + this->Outer, true);
    }
  }
}

} // namespace isopoint
