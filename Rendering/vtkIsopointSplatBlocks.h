// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatBlocks_h
#define vtkIsopointSplatBlocks_h

#include "vtkIsopointSplatBuffers.h"

#include "vtkScatteredIsopointRenderingModule.h" // for the export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkPolyData;

/// A polydata with points, and its display attributes.
struct vtkIsopointSplatLeaf
{
  vtkPolyData* Data = nullptr;
  unsigned int FlatIndex = 0; // within composite input
  bool Visible = true;
  bool HasColor = false; // instead of scalar colors and the material's color
  std::array<double, 3> Color = { 0.0, 0.0, 0.0 };
};

/// The leaves of a data object. Their visibilities and colors are those of the innermost block
/// around them that has any; attributes may be null.
VTKSCATTEREDISOPOINTRENDERING_EXPORT std::vector<vtkIsopointSplatLeaf> vtkIsopointSplatLeaves(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

/**
 * The vtkPolyData that a mapper draws, its input or the leaves of its composite input, with their
 * buffers. A vtkPolyData that remains in the input keeps its buffers.
 */
class vtkIsopointSplatBlocks
{
public:
  struct Block
  {
    vtkSmartPointer<vtkPolyData> Data; // the leaf's
    vtkIsopointSplatLeaf Leaf;
    vtkIsopointSplatBuffers Buffers;
    std::string GeometryState; // identifies the contents of the buffers; empty: none
    std::string ColorState;
    unsigned int Version = 0;           // differs after each change of the buffers
    std::vector<vtkIdType> CellOfPoint; // filled at the first call of CellOfPoint()
  };

  /// Sets the input; null and other data objects have no blocks.
  void SetInput(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

  bool IsComposite() const { return this->Composite; }
  bool IsEmpty() const { return this->Blocks.empty(); }
  const std::vector<std::unique_ptr<Block>>& Get() const { return this->Blocks; }

  /// The block of a flat index, or the only block of input that is not composite; null if there is
  /// none.
  Block* Find(unsigned int flatIndex) const;

  /// The vertex cell of a point, -1 if it has none. O(cells) at the first call, else O(1).
  static vtkIdType CellOfPoint(Block& block, vtkIdType point);

  void ReleaseGraphicsResources();

private:
  std::vector<std::unique_ptr<Block>> Blocks;
  bool Composite = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBlocks.h
