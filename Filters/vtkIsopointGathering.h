// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointGathering_h
#define vtkIsopointGathering_h

#include "vtkIsopointArrays.h"
#include "vtkIsopointBlock.h"

#include <vector>

/**
 * The samples that isopoints lie between, of several blocks put together in one, whose samples are
 * these alone. Surfaces are renumbered to their new ids; the order of ids stays. Attributes that
 * not all blocks have are left out, as vtkAppendFilter does. One block is given back as it is.
 * O(isopoints) memory.
 * @param blocks at least one
 * @param surfaces of the blocks, whose samples are numbered one block after the other
 */
class vtkIsopointGathering
{
public:
  vtkIsopointGathering(
    const std::vector<vtkIsopointBlock>& blocks, std::vector<vtkContouredIsosurface>& surfaces);

  const vtkIsopointBlock& GetBlock() const { return this->Block; }

private:
  vtkIsopointBlock Block; // where gathered, its positions own the attributes and scalars
};

#endif
