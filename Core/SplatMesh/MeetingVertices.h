// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Core/Base/Execution.h"
#include "Core/Base/Vector.h"

#include <array>
#include <cstddef>
#include <vector>

namespace isopoint
{

struct SplatVertex
{
  Vector position;
  std::array<float, 3> normal;
  float tolerance; // how far coincident vertices may be apart; 0: there are none
};

/// Groups vertices that coincide up to rounding, directly or through others: along each axis they
/// are no farther apart than both tolerances, and their normals differ by less than 0.06 degrees.
/// If a vertex coincides with several vertices that do not coincide, it may join only some of them.
/// O(n log n), unless tolerances are large compared with the distances between distinct vertices.
/// @returns for each vertex the first vertex of its group, possibly itself
/// @throws Aborted, std::bad_alloc
std::vector<std::size_t> meetingVertices(
  const Execution& execution, const std::vector<SplatVertex>& vertices);

} // namespace isopoint
