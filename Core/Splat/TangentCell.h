// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TangentCell_h
#define isopoint_TangentCell_h

#include "Core/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// The part of a point's tangent plane that is nearer to it than to other points: a convex polygon
/// around the origin of the plane, cut out of an octagon.
class TangentCell
{
public:
  struct Corner
  {
    double x;
    double y;
    std::size_t side; // what bounds the side that begins here: a point, limit or plane
  };

  static constexpr std::size_t limit = static_cast<std::size_t>(-1); // where no point bounds it
  static constexpr std::size_t plane = static_cast<std::size_t>(-2); // anything else

  /// @param reach of the octagon's corners, whose sides are limits
  TangentCell(const Vector& normal, double reach)
    : Frame(normal)
  {
    for (const auto& [x, y] : directions)
    {
      this->Corners[this->Count++] = { reach * x, reach * y, limit };
    }
    this->SquaredReach = reach * reach;
  }

  /// Keeps the places whose offset o from the point has outward . o <= distance.
  /// @param outward of any length
  /// @param distance not negative
  /// @param side what bounds the new side
  void cut(const Vector& outward, double distance, std::size_t side)
  {
    this->cut(dot(outward, this->Frame.first), dot(outward, this->Frame.second), distance, side);
  }

  /// The same with the components of `outward` along first() and second().
  void cut(double a, double b, double distance, std::size_t side)
  {
    if (distance * distance >= (a * a + b * b) * this->SquaredReach ||
        this->Count == this->Corners.size())
    {
      return;
    }
    // Corners so near to the new side are on it, or rounding might list them twice.
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

  /// The largest (a, b) . o of the cell's places, in the components of their offsets o.
  double reach(double a, double b) const
  {
    double reach = 0.0;
    for (const Corner& corner : *this)
    {
      reach = std::max(reach, a * corner.x + b * corner.y);
    }
    return reach;
  }

  /// How far the cell reaches in a direction.
  double reach(const Vector& direction) const
  {
    return this->reach(dot(direction, this->Frame.first), dot(direction, this->Frame.second));
  }

  /// Cuts the cell down to an octagon whose sides are limits.
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

  /// Drops the shortest sides, whose ends become one corner between them, until so many corners are
  /// left.
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

  /// The square of the distance of the farthest corner.
  double squaredReach() const { return this->SquaredReach; }

  /// Whether a side is a limit.
  bool isOpen() const
  {
    return std::any_of(
      this->begin(), this->end(), [](const Corner& corner) { return corner.side == limit; });
  }

  /// The corners, counterclockwise around first x second, each once.
  const Corner* begin() const { return this->Corners.data(); }
  const Corner* end() const { return this->Corners.data() + this->Count; }

  const TangentFrame& frame() const { return this->Frame; }

private:
  /// Each cut adds a corner at most; cells have about six. Rounding might add more: what would
  /// exceed the capacity is left out.
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

#endif
