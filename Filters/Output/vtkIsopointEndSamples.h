// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointEndSamples_h
#define vtkIsopointEndSamples_h

#include "Core/ExtractionRequest.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Input/vtkIsopointBlock.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

namespace isopoint
{
class Team;
}
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
   * Collective. Where the blocks of several ranks form one cloud, what is at the ends of this
   * rank's isopoints is fetched from the ranks that have it. Arrays that not all ranks with blocks
   * have, and those of other values than numbers and strings, are dropped then.
   * @param blocks of this rank, perhaps none; some rank has one. They must outlive this
   * @param surfaces extracted from the blocks, whose samples are numbered one block after the other
   * @throws std::bad_alloc, and what isopoint::Team does
   */
  vtkIsopointEndSamples(isopoint::Team& team, const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface>& surfaces);
  ~vtkIsopointEndSamples();

  vtkDataSetAttributes* GetAttributes() const { return this->Attributes; }

  /// The contoured array, one of the attributes.
  vtkDataArray* GetScalars() const { return this->Scalars; }

private:
  void CopyFromRanks(isopoint::Team& team, const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface>& surfaces);
  /// Uses the samples that ranks sent, so many in total.
  void Join(const std::vector<isopoint::ByteBuffer>& arrived, std::size_t count);
  /// Uses copies, the last of which is the contoured array.
  void Use(vtkPointData* copied);

  vtkSmartPointer<vtkPointData> Copied; // null for a single block
  vtkDataSetAttributes* Attributes = nullptr;
  vtkDataArray* Scalars = nullptr;
};

#endif
