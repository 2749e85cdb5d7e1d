// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SurfaceTriangle_h
#define isopoint_SurfaceTriangle_h

#include <array>
#include <cstddef>

namespace isopoint
{

/// Three different vertices of a surface, the lowest first. Seen from the side of lower values they
/// stand counterclockwise: the right-hand normal points to decreasing values.
using SurfaceTriangle = std::array<std::size_t, 3>;

} // namespace isopoint

#endif
