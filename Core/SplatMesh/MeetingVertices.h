// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_MeetingVertices_h
#define isopoint_MeetingVertices_h

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

/// A vertex of a splat.
struct SplatVertex
{
  Vector position;
  std::array<float, 3> normal;
  float tolerance; // how far others that are the same may be; 0: there are none
};

/// Which vertices are one, directly or through others, up to rounding: along each axis they are no
/// farther apart than both of their tolerances, and their normals differ by less than 0.06 degrees.
/// A vertex that is one with several others, which are not one, may join some of them alone.
/// O(n log n), unless tolerances are large against the distances between vertices that are not one.
/// @returns for each vertex the first one of its group, perhaps itself
/// @throws Aborted, std::bad_alloc
std::vector<std::size_t> meetingVertices(
  const Execution& execution, const std::vector<SplatVertex>& vertices);

} // namespace isopoint

#endif
