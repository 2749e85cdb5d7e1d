// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_ExtractOnRanks_h
#define isopoint_ExtractOnRanks_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/Extraction/ExpectedWork.h"
#include "Isopoint/Extraction/Isosurface.h"
#include "Isopoint/Extraction/IsosurfaceRequest.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Ranks/NodeExchange.h"
#include "Isopoint/Ranks/RankSurface.h"
#include "Isopoint/Ranks/RankThinning.h"
#include "Isopoint/Tree/CoincidentSamples.h"
#include "Isopoint/Tree/SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace isopoint
{

/// Thins the isopoints of all ranks; see thin(). Collective.
inline void keepOnRanks(
  const Execution& execution, Team& team, double minimumSpacing, Isosurface& surface)
{
  const std::vector<bool> isKept = RankThinning(execution, team, minimumSpacing).kept(surface);
  team.together(
    [&]()
    {
      std::vector<std::size_t> kept;
      for (std::size_t i = 0; i < isKept.size(); ++i)
      {
        if (isKept[i])
        {
          kept.push_back(i);
        }
      }
      surface = chosenIsopoints(surface, kept);
    });
}

} // namespace isopoint

#endif
