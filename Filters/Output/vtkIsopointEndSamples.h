// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointEndSamples_h
#define vtkIsopointEndSamples_h

#include "Core/ExtractionRequest.h"
#include "Core/Ranks/ByteBuffer.h"
#include "Input/vtkIsopointBlocks.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

namespace isopoint
{
class ProcessGroup;
}
class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkPointData;

/// The attributes of the samples at the ends of the isopoints' edges. Those of a single block are
/// used in place. Those of several blocks are copied, and the ids in the surfaces replaced by ids
/// of the copies, in the same order; attributes that not all blocks have are dropped, as in
/// vtkAppendFilter. O(samples at ends) memory for several blocks.
class vtkIsopointEndSamples
{
public:
  enum Numbers
  {
    Values,   // for GetScalars()
    Positions // for GetPosition()
  };

  /// Collective. If the blocks of several ranks form one cloud, fetches the samples at the ends of
  /// this rank's isopoints from their ranks. Arrays that not all ranks with blocks have, and arrays
  /// of other values than numbers and strings, are dropped then.
  /// @param blocks of this rank, possibly none, but not on all ranks; they must outlive this
  /// @param surfaces of the blocks, whose samples are numbered one block after the other
  /// @param numbers what there is besides attributes
  /// @throws std::bad_alloc, and what isopoint::ProcessGroup throws
  vtkIsopointEndSamples(isopoint::ProcessGroup& processes,
    const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface>& surfaces, Numbers numbers = Values);
  ~vtkIsopointEndSamples();

  vtkDataSetAttributes* GetAttributes() const { return this->Attributes; }

  /// The contoured array, one of the attributes. With Positions, any array as long.
  vtkDataArray* GetScalars() const { return this->Scalars; }

  /// @param sample as edges number it
  void GetPosition(std::size_t sample, double position[3]) const;

private:
  void CopyFromRanks(isopoint::ProcessGroup& processes, const std::vector<vtkIsopointBlock>& blocks,
    std::vector<isopoint::ExtractedIsosurface>& surfaces, Numbers numbers);
  /// Uses `count` samples that ranks sent.
  void Join(const std::vector<isopoint::ByteBuffer>& arrived, std::size_t count);
  /// Uses copies, with values or positions at the end.
  void Use(vtkPointData* copied);

  vtkSmartPointer<vtkPointData> Copied; // null for a single block
  vtkDataSetAttributes* Attributes = nullptr;
  vtkDataArray* Scalars = nullptr; // of copies with Positions: these
  vtkDataSet* Block = nullptr;     // a single one: its positions
};

#endif
