// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_MutualSides_h
#define isopoint_MutualSides_h

#include "Core/Base/RawArray.h"
#include "Core/Splat/SplatCell.h"

#include <cstddef>

namespace isopoint
{

/// A point's cell with its sides towards points whose cells have none towards it replaced by the
/// corner where the sides before and after meet or, if that is far away, marked as overlapping. See
/// docs/algorithm.md, section 12.6. O(1)
SplatCell withMutualSides(const RawArray<SplatCell>& cells, std::size_t point);

} // namespace isopoint

#endif
