// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatMapperInternals_h
#define vtkIsopointSplatMapperInternals_h

#include "vtkIsopointSplatBlocks.h"
#include "vtkIsopointSplatBounds.h"
#include "vtkIsopointSplatMapper.h"
#include "vtkIsopointSplatPasses.h"

#include <functional>

class vtkIsopointSplatMapper::Internals
{
public:
  /// Where a splat's color comes from; the values stand in the resolving shader as well.
  enum class Coloring
  {
    Material = 0,
    Colors = 1,
    ColorMap = 2
  };

  /// Does something that may run out of memory. That is one error for each input, not one for each
  /// frame. @returns whether it was done
  bool Try(vtkIsopointSplatMapper* mapper, const std::function<void()>& something);

  /// Fills the buffers of all blocks, and finds their cells where a selector looks for cells.
  /// @returns whether there is anything to draw
  bool Prepare(vtkIsopointSplatMapper* mapper, vtkHardwareSelector* selector);

  void SetUpPasses(vtkIsopointSplatMapper* mapper, vtkRenderer* renderer, vtkActor* actor,
    vtkIsopointSplatPasses::Settings& settings);
  std::vector<vtkIsopointSplatPasses::Block> GetPassBlocks(vtkActor* actor);

  vtkIsopointSplatBlocks Blocks;
  vtkSmartPointer<vtkCompositeDataDisplayAttributes> BlockAttributes;
  vtkIsopointSplatBounds Bounds;
  vtkIsopointSplatPasses Passes;
  Coloring ColoredBy = Coloring::Material;
  bool HasTranslucentColors = false;
  bool WarnedOfNormals = false;
  bool WarnedOfShortArrays = false;
  bool WarnedOfCells = false;
  vtkMTimeType TooManyPlanes = 0; // the change of the clipping planes that was an error
  unsigned long WindowObserver = 0;
  bool ShaderOfComposite = false; // whether the shader at hand was built for composite input
  int ViewportOrigin[2] = { 0, 0 };

private:
  void ReportOutOfMemory(vtkIsopointSplatMapper* mapper);
  void UpdateGeometry(vtkIsopointSplatMapper* mapper);
  void UpdateGeometry(vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block);
  void UpdateColors(vtkIsopointSplatMapper* mapper);
  vtkDataArray* Usable(
    vtkIsopointSplatMapper* mapper, vtkPolyData* data, vtkDataArray* array, int components);
  vtkIsopointSplatBuffers::Shape ShapeOf(vtkIsopointSplatMapper* mapper, vtkPolyData* data);
  bool CanUseColorMap(vtkIsopointSplatMapper* mapper) const;
  void UpdateColors(vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block);
  void MapScalars(
    vtkIsopointSplatMapper* mapper, vtkIsopointSplatBlocks::Block& block, int& cellFlag);

  vtkMTimeType OutOfMemory = 0; // the change of the input that memory was too small for
  unsigned int LastVersion = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatMapperInternals.h
