// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInput_h
#define vtkIsopointInput_h

#include <vector>

namespace isopoint
{
struct Execution;
class IsosurfaceExtractor;
} // namespace isopoint
struct vtkIsopointBlock;

/**
 * Hands the samples of blocks to an extractor, without converting or copying arrays: ids count
 * through one block after the other. Where the extractor holds the same positions already it gets
 * new values only. Throws what IsosurfaceExtractor::load() throws.
 */
void vtkLoadIsopointInput(const isopoint::Execution& execution,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::IsosurfaceExtractor& extractor);

/**
 * Whether the positions of all blocks are stored as float.
 */
bool vtkHaveFloatPositions(const std::vector<vtkIsopointBlock>& blocks);

#endif
