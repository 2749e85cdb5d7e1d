// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInput_h
#define vtkIsopointInput_h

#include <vector>

namespace isopoint
{
class IsosurfaceExtractor;
class Team;
struct Execution;
} // namespace isopoint
struct vtkIsopointBlock;

/**
 * Loads the samples of the blocks of all ranks as one cloud, in the order of the ranks, into an
 * extractor, which reads the arrays in place. If the extractors hold the same positions already,
 * only the values are replaced, and the tree is kept. Collective. Throws what
 * IsosurfaceExtractor::load() throws.
 * @param blocks of this rank, perhaps none
 */
void vtkLoadIsopointInput(const isopoint::Execution& execution, isopoint::Team& team,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::IsosurfaceExtractor& extractor);

/**
 * Whether the positions of all blocks are stored as float.
 */
bool vtkHaveFloatPositions(const std::vector<vtkIsopointBlock>& blocks);

#endif
