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
  /// Source of the splats' colors. vtkIsopointSplatResolveColor.glsl uses the same values.
  enum class Coloring
  {
    Material = 0,
    Colors = 1,
    ColorMap = 2
  };

  /// Calls a function that may throw std::bad_alloc, which is reported once for each input rather
  /// than at each frame.
  /// @returns whether the function returned
  bool Try(vtkIsopointSplatMapper* mapper, const std::function<void()>& function);

  ///@{
  /// Around the drawing of a frame: once one is drawn, a later lack of memory is reported again.
  void BeginFrame() { this->HasLackedMemory = false; }
  void EndFrame() { this->OutOfMemory = this->HasLackedMemory ? this->OutOfMemory : 0; }
  ///@}

  /// Brings the buffers of all blocks up to date, and for a selection of cells the map from points
  /// to cells.
  /// @returns whether there is anything to render
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
  vtkMTimeType TooManyPlanes = 0; // modified time of the clipping planes last reported as too many
  unsigned long WindowObserver = 0;
  bool ShaderOfComposite = false; // whether the current shader was built for composite input
  int Samples = 0;                // per pixel, of the present frame; 0: no multisampling
  int ShaderOfSamples = 0;        // Samples for which the current shader was built
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

  vtkMTimeType OutOfMemory = 0; // modified time of the input last reported as too large
  bool HasLackedMemory = false; // in the present frame
  unsigned int LastVersion = 0;
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatMapperInternals.h
