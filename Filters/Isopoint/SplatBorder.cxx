// SPDX-License-Identifier: GPL-3.0-or-later
#include "SplatBorder.h"

#include <cmath>

namespace isopoint
{
namespace
{

/// In spacings of the samples: how far out of the samples a cell may reach, and how far off they
/// count.
constexpr double outerReach = 0.9;
constexpr double sampleReach = 9.0;

} // namespace

void SplatBorder::moveTo(const Vector& place, const Vector& normal, double spacing)
{
  this->Place = place;
  this->Normal = normal;
  this->Spacing = spacing;
  this->IsAsked = this->Extents && spacing > 0.0 && std::isfinite(sampleReach * spacing);
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
      cell.cut(way.direction, way.extent + outerReach * this->Spacing, true);
    }
  }
}

void SplatBorder::cut(TangentCell& cell)
{
  if (!this->IsAsked)
  {
    return;
  }
  const double outer = outerReach * this->Spacing;
  for (Way& way : this->Ways)
  {
    const double wanted = cell.reachTowards(way.direction) - outer;
    if (wanted > way.extent && !way.isEnd)
    {
      way.extent = this->Extents(
        { this->Place, this->Normal, way.direction, wanted, sampleReach * this->Spacing });
      way.isEnd = way.extent < wanted;
    }
    if (way.isEnd)
    {
      cell.cut(way.direction, way.extent + outer, true);
    }
  }
}

} // namespace isopoint
