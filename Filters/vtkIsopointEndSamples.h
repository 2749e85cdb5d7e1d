// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointEndSamples_h
#define vtkIsopointEndSamples_h

#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlock.h"

#include <vector>

class vtkPointData;

/**
 * The attributes of the samples at the ends of isopoints' edges. Those of several blocks are copied
 * together, and the surfaces renumbered to ids among the copies; the order of ids stays. Attributes
 * that not all blocks have are then left out, as vtkAppendFilter does. Those of a single block are
 * used as they are. Memory: O(isopoints).
 */
class vtkIsopointEndSamples
{
public:
  /**
   * @param blocks at least one; must outlive this
   * @param surfaces of the blocks, whose samples are numbered one block after the other
   * @throws std::bad_alloc
   */
  vtkIsopointEndSamples(const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface>& surfaces);
  ~vtkIsopointEndSamples();

  vtkDataSetAttributes* GetAttributes() const { return this->Attributes; }

  /// The contoured array, one of the attributes.
  vtkDataArray* GetScalars() const { return this->Scalars; }

private:
  vtkSmartPointer<vtkPointData> Copied; // null for a single block
  vtkDataSetAttributes* Attributes;
  vtkDataArray* Scalars;
};

#endif
