// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatCrease.h"

#include "Isopoint/Fit/LocalFit.h"

#include <algorithm>
#include <cmath>

namespace isopoint
{

SplatCrease creaseTowards(const Vector& offset, const Vector& normal, const Vector& otherNormal)
{
  const double cosine = dot(normal, otherNormal);
  // At a convex crease each point lies behind the other's plane, at a concave one before it.
  const double height = dot(normal, offset);
  const double otherHeight = -dot(otherNormal, offset);
  const double side =
    (std::abs(height) > std::abs(otherHeight) ? height : otherHeight) < 0.0 ? -1.0 : 1.0;
  const double inside = std::max(0.0, side * otherHeight);
  return { scaled(side, otherNormal), inside, inside / std::sqrt(1.0 - cosine * cosine), side };
}

std::optional<SplatClip> clipAtNearest(
  const std::vector<SplatCrease>& creases, std::size_t fewest, double agreement, double limit)
{
  const auto isNearer = [](const SplatCrease& a, const SplatCrease& b)
  { return a.distance < b.distance; };
  const auto nearest = std::min_element(creases.begin(), creases.end(), isNearer);
  if (nearest == creases.end() || !(nearest->distance < limit))
  {
    return std::nullopt;
  }
  constexpr std::size_t most = 5;
  std::vector<SplatCrease> planes{ *nearest };
  for (const SplatCrease& crease : creases)
  {
    if (&crease != &*nearest && planes.size() < most &&
        dot(crease.inward, nearest->inward) > mostCreaseCosine)
    {
      planes.push_back(crease);
    }
  }
  if (planes.size() < fewest)
  {
    return std::nullopt;
  }
  std::sort(planes.begin(), planes.end(), isNearer);
  const SplatCrease& middle = planes[planes.size() / 2];
  const auto farthest = std::find_if(planes.rbegin(), planes.rend(),
    [&](const SplatCrease& crease) { return crease.distance <= middle.distance + agreement; });
  return SplatClip{ farthest->inward, farthest->height, farthest->turn };
}

} // namespace isopoint
