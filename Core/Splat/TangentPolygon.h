// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// A convex polygon in a point's tangent plane: its Voronoi cell, cut out of an octagon.
class TangentPolygon
{
public:
  struct Corner
  {
    double x;
    double y;
    std::size_t side; // beyond the side that begins here: a point, limit or plane
  };

  static constexpr std::size_t limit = static_cast<std::size_t>(-1); // no point bounds the side
  static constexpr std::size_t plane = static_cast<std::size_t>(-2); // any other boundary

  /// @param reach distance of the octagon's corners; its sides are limits
  TangentPolygon(const Vector& normal, double reach)
    : Frame(normal)
  {
    for (const auto& [x, y] : directions)
    {
      this->Corners[this->Count++] = { reach * x, reach * y, limit };
    }
    this->SquaredReach = reach * reach;
  }

  /// Keeps the part with outward . o <= distance, where o is the offset from the point.
  /// @param outward of any length
  /// @param distance not negative
  /// @param side what bounds the new side
  void cut(const Vector& outward, double distance, std::size_t side)
  {
    this->cut(dot(outward, this->Frame.first), dot(outward, this->Frame.second), distance, side);
  }

  /// Cuts where the outward direction has these components along the axes of frame().
  void cut(double a, double b, double distance, std::size_t side)
  {
    if (distance * distance >= (a * a + b * b) * this->SquaredReach ||
        this->Count == this->Corners.size())
    {
      return;
    }
    // Corners this close to the new side lie on it; otherwise rounding may duplicate them.
    const double tolerance = 1e-10 * distance;
    std::array<double, capacity> excess;
    double most = 0.0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      excess[i] = a * this->Corners[i].x + b * this->Corners[i].y - distance;
      most = std::max(most, excess[i]);
    }
    if (most > tolerance)
    {
      this->keepInside(excess, tolerance, side);
    }
  }

  /// The maximum of (a, b) . o over the polygon.
  double reach(double a, double b) const
  {
    double reach = 0.0;
    for (const Corner& corner : *this)
    {
      reach = std::max(reach, a * corner.x + b * corner.y);
    }
    return reach;
  }

  /// The maximum of direction . o over the polygon.
  double reach(const Vector& direction) const
  {
    return this->reach(dot(direction, this->Frame.first), dot(direction, this->Frame.second));
  }

  /// Clips the polygon to an octagon whose sides are limits and whose corners have this distance.
  void limitTo(double reach)
  {
    const double height = cosineOfSide * reach; // of the sides
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const auto& [x, y] = directions[i];
      const auto& [nextX, nextY] = directions[(i + 1) % directions.size()];
      this->cut(0.5 * (x + nextX), 0.5 * (y + nextY), cosineOfSide * height, limit);
    }
  }

  /// Replaces the shortest side by a corner at its middle until at most `most` corners are left.
  void reduceTo(std::size_t most)
  {
    const auto squaredSide = [this](std::size_t i)
    {
      const Corner& next = this->Corners[(i + 1) % this->Count];
      const double x = next.x - this->Corners[i].x;
      const double y = next.y - this->Corners[i].y;
      return x * x + y * y;
    };
    while (this->Count > most)
    {
      std::size_t shortest = 0;
      for (std::size_t i = 1; i < this->Count; ++i)
      {
        shortest = squaredSide(i) < squaredSide(shortest) ? i : shortest;
      }
      const Corner from = this->Corners[shortest];
      Corner& to = this->Corners[(shortest + 1) % this->Count];
      to = { 0.5 * (from.x + to.x), 0.5 * (from.y + to.y), to.side };
      std::copy(this->Corners.begin() + static_cast<std::ptrdiff_t>(shortest) + 1,
        this->Corners.begin() + static_cast<std::ptrdiff_t>(this->Count),
        this->Corners.begin() + static_cast<std::ptrdiff_t>(shortest));
      --this->Count;
    }
  }

  /// The squared distance of the farthest corner.
  double squaredReach() const { return this->SquaredReach; }

  /// Whether any side is a limit.
  bool isOpen() const
  {
    return std::any_of(
      this->begin(), this->end(), [](const Corner& corner) { return corner.side == limit; });
  }

  /// The distinct corners, counterclockwise around first x second.
  const Corner* begin() const { return this->Corners.data(); }
  const Corner* end() const { return this->Corners.data() + this->Count; }

  const TangentFrame& frame() const { return this->Frame; }

private:
  /// Each cut adds at most one corner, up to rounding; cells have about six. More are dropped.
  static constexpr std::size_t capacity = 64;

  static constexpr double diagonal = 0.70710678118654752; // 1 / sqrt 2
  static constexpr std::array<std::array<double, 2>, 8> directions{ { { 1.0, 0.0 },
    { diagonal, diagonal }, { 0.0, 1.0 }, { -diagonal, diagonal }, { -1.0, 0.0 },
    { -diagonal, -diagonal }, { 0.0, -1.0 }, { diagonal, -diagonal } } };
  static constexpr double cosineOfSide = 0.92387953251128674; // of 22.5 degrees

  void keepInside(const std::array<double, capacity>& excess, double tolerance, std::size_t side)
  {
    std::array<Corner, capacity> kept;
    std::size_t count = 0;
    double squaredReach = 0.0;
    const auto keep = [&](const Corner& corner)
    {
      if (count == capacity)
      {
        return;
      }
      kept[count++] = corner;
      squaredReach = std::max(squaredReach, corner.x * corner.x + corner.y * corner.y);
    };
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const std::size_t next = i + 1 < this->Count ? i + 1 : 0;
      const Corner& corner = this->Corners[i];
      const bool isOutside = excess[i] > tolerance;
      if (!isOutside)
      {
        keep(corner);
      }
      if (isOutside == (excess[next] > tolerance))
      {
        continue;
      }
      if (std::abs(excess[isOutside ? next : i]) <= tolerance) // on the new side
      {
        if (!isOutside)
        {
          kept[count - 1].side = side;
        }
        continue;
      }
      const Corner& other = this->Corners[next];
      const double t = excess[i] / (excess[i] - excess[next]);
      keep({ corner.x + t * (other.x - corner.x), corner.y + t * (other.y - corner.y),
        isOutside ? corner.side : side });
    }
    std::copy(
      kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count), this->Corners.begin());
    this->Count = count;
    this->SquaredReach = squaredReach;
  }

  TangentFrame Frame;
  std::array<Corner, capacity> Corners;
  std::size_t Count = 0;
  double SquaredReach = 0.0; // of the farthest corner
};

} // namespace isopoint
