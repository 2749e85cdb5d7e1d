// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatBorder_h
#define isopoint_SplatBorder_h

#include "Isopoint/Base/TangentFrame.h"
#include "Isopoint/Base/Vector.h"
#include "Isopoint/Neighbors/SampleExtent.h"
#include "Isopoint/Splat/TangentCell.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace isopoint
{

/// Cuts off the parts of cells that reach out of the samples: where the surface ends, a cell may be
/// bounded only by points along its border, far outside. In each of extentDirections() a cell may
/// reach 0.9 spacings farther than samples stand ahead of its point: each sample represents what is
/// around it. Extents are requested only where a cell reaches out, each once. For one thread.
/// @tparam TExtents SampleExtents, or another class with its at()
template <class TExtents>
class SplatBorder
{
public:
  /// @param extents of the samples; null for none: then there is no border
  explicit SplatBorder(const TExtents* extents)
    : Extents(extents)
  {
  }

  /// Goes to a point.
  /// @param normal of its splat, of length 1
  /// @param spacing of the samples there; if it is not positive, no border is known
  /// @param reach of the samples that count, which may stand across a gap of the cloud; if it is
  /// not finite, no border is known
  void moveTo(const Vector& place, const Vector& normal, double spacing, double reach)
  {
    this->Place = place;
    this->Normal = normal;
    this->Margin = margin * spacing;
    this->Reach = reach;
    this->IsKnown = this->Extents && spacing > 0.0 && std::isfinite(reach);
    const std::array<Vector, extentCount> directions = extentDirections(normal);
    for (std::size_t i = 0; i < extentCount; ++i)
    {
      this->Sides[i] = { directions[i], 0.0, false };
    }
  }

  /// Cuts the point's cell in the directions in which a border has been found.
  void cutWhereFound(TangentCell& cell) const
  {
    for (const Side& side : this->Sides)
    {
      if (side.isBorder)
      {
        cell.cut(side.direction, side.extent + this->Margin, true);
      }
    }
  }

  /// Cuts the point's cell in all directions in which it reaches out; the cuts count as sides of
  /// the disk.
  void cut(TangentCell& cell)
  {
    if (!this->IsKnown)
    {
      return;
    }
    for (Side& side : this->Sides)
    {
      const double wanted = cell.reachTowards(side.direction) - this->Margin;
      if (wanted > side.extent && !side.isBorder)
      {
        side.extent =
          this->Extents->at({ this->Place, this->Normal, side.direction, wanted, this->Reach });
        side.isBorder = side.extent < wanted;
      }
      if (side.isBorder)
      {
        cell.cut(side.direction, side.extent + this->Margin, true);
      }
    }
  }

private:
  /// How far out of the samples a cell may reach, in their spacings.
  static constexpr double margin = 0.9;

  struct Side
  {
    Vector direction;
    double extent; // how far samples stand ahead, at least
    bool isBorder; // whether they stand no farther
  };

  const TExtents* Extents;
  Vector Place{};
  Vector Normal{};
  double Margin = 0.0;
  double Reach = 0.0; // of the samples that count
  std::array<Side, extentCount> Sides{};
  bool IsKnown = false; // whether a border can be found at all
};

} // namespace isopoint

#endif
