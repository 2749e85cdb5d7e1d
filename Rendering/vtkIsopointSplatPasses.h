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
 * The off-screen passes that turn splats into a surface at every pixel [BHZK05]: a visibility pass,
 * then weighted blending of the splats within the blend depth behind the visible ones. For
 * translucent surfaces both are repeated for each layer behind.
 *
 * The passes are rendered again only after a change: depth peeling and hardware selection, which
 * render an actor several times per frame, render its splats once.
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
    unsigned int Version; // differs after each change of the buffers
    unsigned int Index;   // written with the ids
    std::array<float, 4> PlainColor;
  };

  /// All that the surface at a pixel depends on, except for the blocks.
  struct Settings
  {
    int Size[2] = { 0, 0 };           // of the viewport, in pixels
    vtkNew<vtkMatrix4x4> ModelToView; // both transposed, as VTK's cameras and actors store matrices
    vtkNew<vtkMatrix4x4> ViewToClip;
    bool ParallelProjection = false;
    std::vector<std::array<double, 4>> ClippingPlanes; // in view coordinates
    double RadiusScale = 1.0;
    double BlendDepth = 1.0;
    int Stride = 1;
    int CulledFacing = 0; // 1: front faces, -1: back faces, 0: none
    int NumberOfLayers = 1;
    int Samples = 0;       // per pixel; 0: one, without multisampling
    bool HasColors = true; // false: the colors of a layer are not read
    bool TranslucentColors = false;
    bool BlendsGhosts = false;
    bool Ids = false;
  };

  /// The sums at each pixel of one layer.
  struct Layer
  {
    vtkNew<vtkTextureObject> Depth; // up to which splats are blended; 1 where there are none
    vtkNew<vtkTextureObject> Surface;
    vtkNew<vtkTextureObject> Color;
    vtkNew<vtkTextureObject> Opacity;
    vtkNew<vtkTextureObject> Outline; // for samples, see vtkIsopointSplatFS.glsl
    vtkNew<vtkTextureObject> Own;     // the weight, without that of ghosts
    vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
    int Samples = 0;                    // in each texture, 0: these have no samples
    std::vector<float> SamplePositions; // x, y of each, in pixels, from the pixel's center
    bool HasOutline = false;            // apart from the color, in place of which it may stand
    bool HasOpacity = false;
    bool HasOwn = false;
    std::vector<vtkTextureObject*> Attached; // to the framebuffer, but for the depth
  };

  /// Samples per pixel of the bound framebuffer; 0 without multisampling, and where shaders have no
  /// access to samples.
  static int SamplesOfFramebuffer();

  /// Sets a program's array of the positions of a layer's samples.
  static void SetSamplePositions(vtkShaderProgram* program, const char* name, const Layer& layer);

  /// The window to render for. Resources of a former window must have been released before. The
  /// window may be deleted at any time, and is null then.
  void SetWindow(vtkOpenGLRenderWindow* window) { this->Window = window; }
  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  /// Brings the layers up to date, in the window's context.
  /// @throws std::bad_alloc, after which ReleaseGraphicsResources is to be called
  void Render(const Settings& settings, const std::vector<Block>& blocks);

  /// Of the last Render, nearest first, without empty layers.
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
  std::vector<double> State; // the settings and blocks that the layers show
  bool HasIds = false;       // whether Ids is of these layers
};

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatPasses.h
