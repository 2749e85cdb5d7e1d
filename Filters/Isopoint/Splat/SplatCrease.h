// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SplatCrease_h
#define isopoint_SplatCrease_h

#include "Isopoint/Base/Vector.h"
#include "Isopoint/Splat/Splat.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace isopoint
{

/// The plane of a point across a crease, as seen from a splat's centre.
struct SplatCrease
{
  Vector inward;   // normal to it, to the splat's side
  double height;   // of the centre over it
  double distance; // of the centre from the crease, along the splat
  double turn;     // to which side of the splat the surface turns there: 1 its normal's, or -1
};

/// @param offset of the point across from the centre
/// @param normal of the splat, of length 1
/// @param otherNormal of that point, of length 1, not along the splat's
SplatCrease creaseTowards(const Vector& offset, const Vector& normal, const Vector& otherNormal);

/// The clipping plane of a splat: the median of the planes of the nearest points across the nearest
/// crease, since one of them may be a little off, or the farthest of those that agree with it, so
/// that no gap is left between both sides.
/// @param creases by the distance of the points across
/// @param fewest planes of one crease that are required
/// @param agreement the largest difference between the distances of planes that agree
/// @param limit of the distance of a crease that clips
std::optional<SplatClip> clipAtNearest(
  const std::vector<SplatCrease>& creases, std::size_t fewest, double agreement, double limit);

} // namespace isopoint

#endif
