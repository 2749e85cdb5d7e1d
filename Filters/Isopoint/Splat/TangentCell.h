// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_TangentCell_h
#define isopoint_TangentCell_h

#include "Isopoint/Base/TangentFrame.h"
#include "Isopoint/Base/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// The part of a point's tangent plane that is nearer to it than to other points: a convex polygon
/// around the origin of the plane, cut out of a disk.
class TangentCell
{
public:
  struct Corner
  {
    double x;
    double y;
    bool isLimit; // whether the side that begins here is one of the disk's, or counts as one
  };

  explicit TangentCell(const Vector& normal)
    : Frame(normal)
  {
  }

  /// Starts again with a disk.
  void reset(double limit)
  {
    constexpr double half = 0.5;
    constexpr double most = 0.86602540378443865; // sqrt(3) / 2
    constexpr std::array<std::array<double, 2>, 12> directions{ { { 1.0, 0.0 }, { most, half },
      { half, most }, { 0.0, 1.0 }, { -half, most }, { -most, half }, { -1.0, 0.0 },
      { -most, -half }, { -half, -most }, { 0.0, -1.0 }, { half, -most }, { most, -half } } };
    this->Corners.clear();
    for (const auto& [x, y] : directions)
    {
      this->Corners.push_back({ limit * x, limit * y, true });
    }
    this->SquaredReach = limit * limit;
  }

  /// Keeps the places whose offset o from the point has outward . o <= distance.
  /// @param isLimit whether the cut is to count as one of the disk's sides
  void cut(const Vector& outward, double distance, bool isLimit = false)
  {
    const double a = dot(outward, this->Frame.first);
    const double b = dot(outward, this->Frame.second);
    const auto excess = [=](const Corner& corner)
    { return a * corner.x + b * corner.y - distance; };
    if (distance >= 0.0 && distance * distance >= (a * a + b * b) * this->SquaredReach)
    {
      return;
    }
    this->Cut.clear();
    for (std::size_t i = 0; i < this->Corners.size(); ++i)
    {
      const Corner& corner = this->Corners[i];
      const Corner& next = this->Corners[(i + 1) % this->Corners.size()];
      const double here = excess(corner);
      const double there = excess(next);
      if (here <= 0.0)
      {
        this->Cut.push_back(corner);
      }
      if ((here <= 0.0) != (there <= 0.0))
      {
        const double t = here / (here - there);
        this->Cut.push_back({ corner.x + t * (next.x - corner.x),
          corner.y + t * (next.y - corner.y), here > 0.0 ? corner.isLimit : isLimit });
      }
    }
    this->Corners.swap(this->Cut);
    this->SquaredReach = 0.0;
    for (const Corner& corner : this->Corners)
    {
      this->SquaredReach = std::max(this->SquaredReach, corner.x * corner.x + corner.y * corner.y);
    }
  }

  /// How far the cell reaches in a direction.
  double reachTowards(const Vector& direction) const
  {
    const double a = dot(direction, this->Frame.first);
    const double b = dot(direction, this->Frame.second);
    double reach = 0.0;
    for (const Corner& corner : this->Corners)
    {
      reach = std::max(reach, a * corner.x + b * corner.y);
    }
    return reach;
  }

  /// The distance of the farthest corner.
  double reach() const { return std::sqrt(this->SquaredReach); }

  /// Whether a part of the disk's rim is left.
  bool isOpen() const
  {
    return std::any_of(this->Corners.begin(), this->Corners.end(),
      [](const Corner& corner) { return corner.isLimit; });
  }

  /// Whether the sides turn by no more than 120 degrees at any corner, so that none is much farther
  /// off than the points across its sides.
  bool isRound() const
  {
    constexpr double leastCosine = -0.5;
    // Cuts through a corner leave it twice.
    std::vector<Corner> sides;
    for (std::size_t i = 0; i < this->Corners.size(); ++i)
    {
      const Corner& corner = this->Corners[i];
      const Corner& next = this->Corners[(i + 1) % this->Corners.size()];
      const double length = std::hypot(next.x - corner.x, next.y - corner.y);
      if (length > 0.0)
      {
        sides.push_back({ (next.x - corner.x) / length, (next.y - corner.y) / length, false });
      }
    }
    bool isRound = sides.size() > 2;
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      const Corner& next = sides[(i + 1) % sides.size()];
      isRound = isRound && sides[i].x * next.x + sides[i].y * next.y >= leastCosine;
    }
    return isRound;
  }

  const std::vector<Corner>& corners() const { return this->Corners; }
  const Vector& first() const { return this->Frame.first; }
  const Vector& second() const { return this->Frame.second; }

private:
  TangentFrame Frame;
  std::vector<Corner> Corners;
  std::vector<Corner> Cut;
  double SquaredReach = 0.0; // of the farthest corner
};

} // namespace isopoint

#endif
