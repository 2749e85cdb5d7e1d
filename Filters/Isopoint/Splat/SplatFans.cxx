// SPDX-License-Identifier: GPL-3.0-or-later
#include "Isopoint/Splat/SplatFans.h"

#include "Isopoint/Base/TangentFrame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isopoint
{

/// What is beyond the side that begins at a corner or, backward, the one that ends there.
std::size_t SplatFans::beyond(const Corner& corner, bool isOnward) const
{
  const SplatCell& cell = this->Cells[corner.point];
  const std::size_t before = (corner.number + cell.count - 1) % cell.count;
  return cell.corners[isOnward ? corner.number : before].beyond;
}

/// Whether both sides at a corner are cuts halfway to other points: the surface goes on there.
bool SplatFans::isBetweenPoints(const Corner& corner) const
{
  return this->beyond(corner, true) != SplatCell::none &&
         this->beyond(corner, false) != SplatCell::none;
}

/// The corner of the cell across a side that is at the same place.
std::optional<SplatFans::Corner> SplatFans::across(const Corner& corner, bool isOnward) const
{
  const std::size_t beyond = this->beyond(corner, isOnward);
  if (!SplatCell::isPoint(beyond))
  {
    return std::nullopt;
  }
  const SplatCell& other = this->Cells[beyond];
  for (std::size_t i = 0; i < other.count; ++i)
  {
    if (other.corners[i].beyond == corner.point)
    {
      return Corner{ beyond, isOnward ? (i + 1) % other.count : i };
    }
  }
  return std::nullopt;
}

/// A corner on the paraboloid of its point.
SplatFans::Place SplatFans::placeOf(const Corner& corner) const
{
  const SplatCell& cell = this->Cells[corner.point];
  const auto& [x, y, beyond] = cell.corners[corner.number];
  const Vector& normal = this->Splats[corner.point].normal;
  const TangentFrame frame(normal);
  const double slopeX = cell.curvature.xx * x + cell.curvature.xy * y;
  const double slopeY = cell.curvature.xy * x + cell.curvature.yy * y;
  const double height = 0.5 * (slopeX * x + slopeY * y);
  Vector position = sum(this->Positions[corner.point], cell.unit * x, frame.first);
  position = sum(position, cell.unit * y, frame.second);
  position = sum(position, cell.unit * height, normal);
  const Vector upwards = sum(sum(normal, -slopeX, frame.first), -slopeY, frame.second);
  return { corner, position, directionOf(upwards), cell.unit * std::sqrt(x * x + y * y) };
}

/// Whether two corners may be one place: the normals do not oppose, and the two are no farther
/// apart than 1.2 times as far as they are from their points.
bool SplatFans::areClose(const Place& a, const Place& b) const
{
  constexpr double mostShare = 1.2;
  return dot(this->Splats[a.corner.point].normal, this->Splats[b.corner.point].normal) > 0.0 &&
         lengthOf(difference(a.position, b.position)) <=
           mostShare * 0.5 * (a.distance + b.distance);
}

void SplatFans::Meeting::add(const Place& place)
{
  this->isTooLarge = this->count == this->places.size();
  if (this->isTooLarge)
  {
    return;
  }
  const Corner& corner = place.corner;
  std::size_t i = this->count++;
  for (; i > 0; --i)
  {
    const Corner& before = this->places[i - 1].corner;
    if (before.point < corner.point ||
        (before.point == corner.point && before.number < corner.number))
    {
      break;
    }
    this->places[i] = this->places[i - 1];
  }
  this->places[i] = place;
}

/// Adds the corners that follow the first one, from cell to cell around the place where they meet.
/// @returns whether this leads back to it
bool SplatFans::follow(const Place& first, bool isOnward, Meeting& meeting) const
{
  Place last = first;
  while (!meeting.isTooLarge)
  {
    const std::optional<Corner> next = this->across(last.corner, isOnward);
    if (!next)
    {
      meeting.isOverlapping |= this->beyond(last.corner, isOnward) == SplatCell::overlapping;
      return false;
    }
    if (next->point == first.corner.point && next->number == first.corner.number)
    {
      return true;
    }
    const Place place = this->placeOf(*next);
    if (!this->areClose(last, place))
    {
      return false;
    }
    meeting.add(place);
    last = place;
  }
  return false;
}

/// A corner where it meets others: at the mean of all, the same for each of them.
SplatFans::Place SplatFans::joined(const Corner& corner) const
{
  Place place = this->placeOf(corner);
  Meeting meeting;
  meeting.add(place);
  if (!this->follow(place, true, meeting))
  {
    this->follow(place, false, meeting);
  }
  const bool isInside = this->isBetweenPoints(corner);
  if (meeting.isTooLarge || meeting.isOverlapping || (meeting.count < 3 && isInside))
  {
    // Where cells do not agree, those around overlap, so that nothing gapes.
    constexpr double overlap = 0.1;
    const Vector outward = difference(place.position, this->Positions[corner.point]);
    place.position = sum(place.position, isInside ? overlap : 0.0, outward);
    return place;
  }
  const Vector& origin = meeting.places.front().position;
  Vector offset{ 0.0, 0.0, 0.0 };
  Vector normal{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < meeting.count; ++i)
  {
    offset = sum(offset, 1.0, difference(meeting.places[i].position, origin));
    normal = sum(normal, 1.0, meeting.places[i].normal);
  }
  place.position = sum(origin, 1.0 / static_cast<double>(meeting.count), offset);
  place.normal = directionOf(normal);
  return place;
}

/// Swaps corners until they follow each other counterclockwise: brought together with others, two
/// may have passed each other.
void SplatFans::turnOneWay(const TangentFrame& frame, std::size_t count,
  std::array<Vector, mostCorners>& offsets, std::array<Vector, mostCorners>& normals)
{
  const auto turn = [&](std::size_t i, std::size_t next)
  {
    return dot(offsets[i], frame.first) * dot(offsets[next], frame.second) -
           dot(offsets[i], frame.second) * dot(offsets[next], frame.first);
  };
  for (std::size_t pass = 0; pass < count; ++pass)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t next = (i + 1) % count;
      if (turn(i, next) < 0.0)
      {
        std::swap(offsets[i], offsets[next]);
        std::swap(normals[i], normals[next]);
      }
    }
  }
}

void SplatFans::shape(std::size_t point, Splat& splat) const
{
  const SplatCell& cell = this->Cells[point];
  const TangentFrame frame(splat.normal);
  std::array<Vector, mostCorners> offsets{};
  std::array<Vector, mostCorners> normals{};
  splat.radius = 0.0;
  for (std::size_t i = 0; i < cell.count; ++i)
  {
    const Place place = this->joined({ point, i });
    offsets[i] = difference(place.position, this->Positions[point]);
    normals[i] = place.normal;
    splat.radius = std::max(splat.radius, lengthOf(offsets[i]));
  }
  splat.axis = scaled(splat.radius, frame.first);
  turnOneWay(frame, cell.count, offsets, normals);
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

} // namespace isopoint
