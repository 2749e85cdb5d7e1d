// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointEndSamples_h
#define vtkIsopointEndSamples_h

#include "Isopoint/IsosurfaceExtractor.h"
#include "vtkIsopointBlock.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;

/**
 * The attributes of the samples at the ends of the isopoints' edges. Those of a single block are
 * used in place. Those of several blocks are copied together, and the ids in the surfaces replaced
 * by ids of the copies, in the same order; attributes that not all blocks have are dropped, as by
 * vtkAppendFilter. O(samples at ends) memory, for several blocks.
 */
class vtkIsopointEndSamples
{
public:
  /**
   * @param blocks at least one; must outlive this
   * @param surfaces extracted from the blocks, whose samples are numbered one block after the other
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
