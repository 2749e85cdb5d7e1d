// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatPasses_h
#define vtkIsopointSplatPasses_h

#include "vtkIsopointSplatBuffers.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkWeakPointer.h"

#include <array>
#include <memory>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkShaderProgram;
class vtkTextureObject;

/**
 * The off-screen passes that turn splats into a surface at every pixel: visibility, then weighted
 * blending of what lies within the blend depth of it (Botsch et al., High-Quality Surface Splatting
 * on Today's GPUs, 2005), and, for translucent surfaces, the same for each layer behind.
 *
 * Nothing is drawn again where nothing changed: the passes of depth peeling and of hardware
 * selection cost one frame's splats, not one each.
 */
class vtkIsopointSplatPasses
{
public:
  vtkIsopointSplatPasses();
  ~vtkIsopointSplatPasses();
  vtkIsopointSplatPasses(const vtkIsopointSplatPasses&) = delete;
  vtkIsopointSplatPasses& operator=(const vtkIsopointSplatPasses&) = delete;

  static constexpr int MaximumNumberOfClippingPlanes = 6; // the shaders' arrays have as many

  struct Block
  {
    vtkIsopointSplatBuffers* Buffers;
    unsigned int Version; // another one after each change of the buffers
    unsigned int Index;   // given back with the ids
    std::array<float, 4> PlainColor;
  };

  /// All that the surface at a pixel depends on, the blocks apart.
  struct Settings
  {
    int Size[2] = { 0, 0 };           // of the viewport, in pixels
    vtkNew<vtkMatrix4x4> ModelToView; // VTK's camera and actor store them, and all of these,
    vtkNew<vtkMatrix4x4> ViewToClip;  // transposed
    bool ParallelProjection = false;
    std::vector<std::array<double, 4>> ClippingPlanes; // in view coordinates, so many at most
    double RadiusScale = 1.0;
    double BlendDepth = 1.0;
    int Stride = 1;
    int CulledFacing = 0; // 1: front faces, -1: back faces, 0: none
    int NumberOfLayers = 1;
    bool TranslucentColors = false;
    bool Ids = false;
  };

  /// The sums at each pixel of one layer.
  struct Layer
  {
    vtkNew<vtkTextureObject> Depth; // as far as blending reaches; 1 where nothing is
    vtkNew<vtkTextureObject> Surface;
    vtkNew<vtkTextureObject> Color;
    vtkNew<vtkTextureObject> Opacity;
    vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
    bool HasOpacity = false;
  };

  /// The window to render for; what was made for another one is to be released before. It may go
  /// away at any time, and is null then.
  void SetWindow(vtkOpenGLRenderWindow* window) { this->Window = window; }
  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  /// Brings the layers up to date, in the window's context.
  void Render(const Settings& settings, const std::vector<Block>& blocks);

  /// Of the last Render, nearest first; layers that nothing was seen of are left out.
  int GetNumberOfLayers() const { return this->NumberOfLayers; }
  const Layer& GetLayer(int index) const { return *this->Layers[index]; }
  vtkTextureObject* GetIds() const { return this->Ids; }

  /// To be called in the window's context.
  void ReleaseGraphicsResources();

private:
  enum class Pass
  {
    Visibility,
    Blend,
    Ids
  };

  void RenderLayers(const Settings& settings, const std::vector<Block>& blocks);
  bool IsUpToDate(const Settings& settings, const std::vector<Block>& blocks);
  void PrepareLayer(Layer& layer, const Settings& settings);
  void ReleaseLayer(Layer& layer);
  void PrepareIds(const Settings& settings);
  bool RenderLayer(int index, const Settings& settings, const std::vector<Block>& blocks);
  void RenderIds(const Settings& settings, const std::vector<Block>& blocks);
  void DrawBlocks(Pass pass, int layer, const Settings& settings, const std::vector<Block>& blocks);
  vtkShaderProgram* ReadyProgram(
    Pass pass, bool isDeeper, const Settings& settings, const vtkIsopointSplatBuffers& buffers);
  void SetUniforms(
    vtkShaderProgram* program, Pass pass, const Settings& settings, const Block& block);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  std::vector<std::unique_ptr<Layer>> Layers;
  int NumberOfLayers = 0;
  vtkNew<vtkTextureObject> Ids;
  vtkNew<vtkTextureObject> IdDepth;
  vtkNew<vtkOpenGLFramebufferObject> IdFramebuffer;
  std::vector<double> State; // what the layers were drawn of
  bool HasIds = false;       // of these layers
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatPasses.h
