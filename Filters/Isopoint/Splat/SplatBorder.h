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

/// How far around itself a sample represents its surroundings, in spacings.
constexpr double sampleReach = 0.9;

/// How far a splat may reach out of the samples, in spacings.
constexpr double borderReach = 0.3;

/// Cuts off the parts of cells that reach out of the samples: where the surface ends, a cell may be
/// bounded only by points along its border, far outside. In each of extentDirections() a cell may
/// reach `borderReach` farther than samples stand ahead of its point. Extents are requested only
/// where a cell reaches out, each once. For one thread.
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
  /// @param spacing of the samples there, the unit of the cell; if it is not positive, no border is
  /// known
  void moveTo(const Vector& place, const Vector& normal, double spacing)
  {
    this->Place = place;
    this->Normal = normal;
    this->Spacing = spacing;
    this->IsKnown = this->Extents && spacing > 0.0 && std::isfinite(reach * spacing);
    this->Extent.fill(0.0);
    this->IsBorder.fill(false);
  }

  /// Cuts the point's cell in all directions in which it reaches out; the new sides are limits.
  void cut(TangentCell& cell)
  {
    if (!this->IsKnown)
    {
      return;
    }
    const std::array<Vector, extentCount> directions = extentDirections(this->Normal);
    for (std::size_t i = 0; i < extentCount; ++i)
    {
      const double wanted = cell.reachTowards(directions[i]) - borderReach;
      if (wanted > this->Extent[i] && !this->IsBorder[i])
      {
        this->Extent[i] = this->Extents->at({ this->Place, this->Normal, directions[i],
                            wanted * this->Spacing, reach * this->Spacing }) /
                          this->Spacing;
        this->IsBorder[i] = this->Extent[i] < wanted;
      }
      if (this->IsBorder[i])
      {
        cell.cut(directions[i], this->Extent[i] + borderReach, TangentCell::limit);
      }
    }
  }

private:
  /// How far away samples count, in spacings: a cell is as far from what is across a gap as it may
  /// reach into it.
  static constexpr double reach = 9.0;

  const TExtents* Extents;
  Vector Place{};
  Vector Normal{};
  double Spacing = 0.0;
  bool IsKnown = false;                     // whether a border can be found at all
  std::array<double, extentCount> Extent{}; // how far samples stand ahead, at least, in spacings
  std::array<bool, extentCount> IsBorder{}; // whether they stand no farther
};

} // namespace isopoint

#endif
