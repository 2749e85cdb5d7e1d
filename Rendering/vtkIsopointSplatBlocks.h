// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatBlocks_h
#define vtkIsopointSplatBlocks_h

#include "vtkIsopointSplatBuffers.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkPolyData;

/// A polydata with points that a mapper may draw.
struct vtkIsopointSplatLeaf
{
  vtkPolyData* Data = nullptr;
  unsigned int FlatIndex = 0; // within composite input
  bool Visible = true;
  bool HasColor = false; // of its own, instead of the scalars' and the material's
  std::array<double, 3> Color = { 0.0, 0.0, 0.0 };
};

/// Those in a data object. Visibilities and colors are given to them or to blocks that they are in,
/// of which the innermost counts; attributes may be null.
std::vector<vtkIsopointSplatLeaf> vtkIsopointSplatLeaves(
  vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

/**
 * The vtkPolyData that a mapper draws: its input, or the leaves of its composite input, each with
 * its buffers, which are kept as long as it stays the same.
 */
class vtkIsopointSplatBlocks
{
public:
  struct Block
  {
    vtkSmartPointer<vtkPolyData> Data; // the leaf's
    vtkIsopointSplatLeaf Leaf;
    vtkIsopointSplatBuffers Buffers;
    std::string GeometryState; // what the buffers were filled from
    std::string ColorState;
    unsigned int Version = 0;           // another one after each change of the buffers
    std::vector<vtkIdType> CellOfPoint; // vertex cells, found when first asked for
  };

  /// Takes the points of an input; null and other data objects have none.
  void SetInput(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes);

  bool IsComposite() const { return this->Composite; }
  bool IsEmpty() const { return this->Blocks.empty(); }
  const std::vector<std::unique_ptr<Block>>& Get() const { return this->Blocks; }

  /// The block of a flat index, or the only one of input that is not composite; else null.
  Block* Find(unsigned int flatIndex) const;

  /// The vertex cell of a point; -1 for a point that has none. O(cells) the first time.
  static vtkIdType CellOfPoint(Block& block, vtkIdType point);

  void ReleaseGraphicsResources();

private:
  std::vector<std::unique_ptr<Block>> Blocks;
  bool Composite = false;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatBlocks.h
