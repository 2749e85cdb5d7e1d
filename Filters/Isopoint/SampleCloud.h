// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef isopoint_SampleCloud_h
#define isopoint_SampleCloud_h

#include "Isopoint/Base/Execution.h"
#include "Isopoint/Base/Team.h"
#include "Isopoint/ExtractionRequest.h"
#include "Isopoint/Neighbors/NeighborhoodCache.h"
#include "Isopoint/Tree/SampleTree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isopoint
{

/// The samples of one layout, and what has been found out about them.
template <class TSample>
struct SampleCloud
{
  SampleTree<TSample> tree;
  NeighborhoodCache<typename TSample::Id> neighborhoods;
  std::vector<std::uint64_t> begins; // see SharedTree; of a cloud on ranks
};

/// What IsosurfaceExtractor::extract() does, for one layout of samples. Each layout is compiled in
/// a file of its own, since that takes long.
/// @param itemCount of all ranks, those left out included
/// @param team null unless the cloud is on ranks
template <class TSample>
ExtractedIsosurface extractFromCloud(const Execution& execution, SampleCloud<TSample>& cloud,
  std::size_t itemCount, Team* team, const ExtractionRequest& request, ExtractedIsosurface* ghosts);

} // namespace isopoint

#endif
