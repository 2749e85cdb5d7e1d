// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_BandMarks_h
#define isopoint_BandMarks_h

#include <cstdint>

namespace isopoint
{

/// What NodeMarks say of nodes while the crossing tetrahedra are found.
namespace bandmarks
{

/// The leaf's samples are a vertex of the band's triangulation.
inline constexpr std::uint8_t inBand = 1;

/// The sphere of a crossing tetrahedron may reach the region of the node, which has no children.
inline constexpr std::uint8_t reached = 2;

} // namespace bandmarks

} // namespace isopoint

#endif
