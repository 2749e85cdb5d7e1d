// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatBorder_h
#define isopoint_SplatBorder_h

#include "Isopoint/Neighbors/ExtentQuery.h"
#include "Isopoint/Splat/TangentCell.h"
#include "Isopoint/Base/TangentFrame.h"
#include "Isopoint/Base/Vector.h"

#include <array>
#include <cstddef>

namespace isopoint
{

/// Cuts cells off that reach out of the samples: where the surface ends, one may be bounded by
/// points along its border alone, far outside. In each of extentDirections() a cell may reach 0.9
/// spacings farther than samples stand ahead of its point: each stands for what is around it.
/// Samples are asked for only where a cell reaches out; what they tell is remembered.
class SplatBorder
{
public:
  /// @param extents tells how far samples stand ahead; may be empty: then there is no border
  explicit SplatBorder(const SampleExtents& extents)
    : Extents(extents)
  {
  }

  /// Goes to a point.
  /// @param normal of its splat, of length 1
  /// @param spacing of the samples there; where it is not positive, nothing tells of a border
  /// @param reach of the samples that count, which may stand across a gap of the cloud; if it is
  /// not finite, nothing tells of a border
  void moveTo(const Vector& place, const Vector& normal, double spacing, double reach);

  /// Cuts the point's cell in the directions that are known to lead out.
  void cutWhereKnown(TangentCell& cell) const;

  /// Cuts the point's cell in all directions that lead out; the cuts count as sides of the disk.
  void cut(TangentCell& cell);

private:
  struct Way
  {
    Vector direction;
    double extent; // that samples stand ahead, at least
    bool isEnd;    // whether they stand no farther
  };

  const SampleExtents& Extents;
  Vector Place{};
  Vector Normal{};
  double Outer = 0.0; // how far out of the samples a cell may reach
  double Reach = 0.0; // of the samples that count
  std::array<Way, extentCount> Ways{};
  bool IsAsked = false; // whether there is anything to ask
};

} // namespace isopoint

#endif
