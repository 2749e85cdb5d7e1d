// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInput_h
#define vtkIsopointInput_h

#include <vector>

namespace isopoint
{
class IsosurfaceExtractor;
class ProcessGroup;
struct CloudCounts;
struct Execution;
struct SampleTypes;
} // namespace isopoint
struct vtkIsopointBlock;

/// The sample types of all blocks.
isopoint::SampleTypes vtkGetIsopointSampleTypes(const std::vector<vtkIsopointBlock>& blocks);

/// The samples of all blocks.
isopoint::CloudCounts vtkCountIsopointSamples(const std::vector<vtkIsopointBlock>& blocks);

/// Loads the samples of the blocks of all ranks as one cloud, in the order of the ranks. The
/// extractor reads the arrays in place; see isopoint::loadOrReplace(). Collective.
/// @param types of all ranks
/// @param blocks of this rank, possibly none
void vtkLoadIsopointInput(const isopoint::Execution& execution, isopoint::ProcessGroup& processes,
  const isopoint::SampleTypes& types, const std::vector<vtkIsopointBlock>& blocks,
  isopoint::IsosurfaceExtractor& extractor);

#endif
