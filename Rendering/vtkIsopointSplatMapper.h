// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatMapper
 * @brief   renders points with normals and radii as one lit surface
 *
 * Each point is rendered as a splat: a disk or an ellipse in the plane orthogonal to its normal.
 * Splats within BlendDepth of the visible surface are blended, with weights that decrease from a
 * splat's center to its rim: normals, depths and colors alike. The blended surface is lit once per
 * pixel and looks like a smooth mesh (surface splatting [ZPBG01] with deferred shading [BHZK05]).
 *
 * Input is vtkPolyData, or a composite data set of them (SetInputDataObject or
 * SetInputConnection). All points are rendered, with or without cells, except for hidden and
 * duplicated ghost points (but see SetBlendGhosts()) and points whose position or radius is not
 * finite. Normals are the active point normals; without them splats face the camera, and one
 * warning is given. Radii are in the array RadiusArrayName, half-axes of ellipses in
 * SplatAxis1ArrayName and SplatAxis2ArrayName, and clipping planes of single splats in
 * SplatClipArrayName, as vtkScatteredIsopointFilter writes them.
 *
 * Lights, materials, physically based rendering, scalar coloring, opacity, clipping planes,
 * transforms of the actor, face culling, a back face property, SSAO, FXAA, depth peeling,
 * order-independent translucency, shadows, sub-viewports and hardware selection work as for a
 * mesh: the blended surface passes through the fragment shader that vtkOpenGLPolyDataMapper
 * composes, with the user's shader replacements. Textures of the actor are not applied. Of a
 * translucent surface up to MaximumNumberOfLayers layers are rendered, with depth peeling and
 * without.
 *
 * In a window with multisampling (vtkRenderWindow::SetMultiSamples(), 8 by default) outlines,
 * creases and intersections with other surfaces are as smooth as those of a mesh, and the parts of
 * splats that reach out beyond the horizon of a curved surface are cut away. This takes 36 bytes of
 * graphics memory per sample of the window, 52 with colors. Translucent surfaces, and frames for a
 * hardware selection, have one sample per pixel, as have all where OpenGL lacks
 * GL_ARB_sample_shading.
 *
 * A hardware selection finds the splat that is seen at a pixel: of the splats that cover the pixel
 * at the visible surface, the one whose center is nearest, in radii. Selections of cells find the
 * points' vertex cells.
 *
 * @warning Composite input is colored by coordinates in a color map
 * (InterpolateScalarsBeforeMapping) only if every block has the array.
 * @warning Filters that rotate or scale points leave arrays of radii, axes and planes as they were:
 * rotate or scale the actor instead. Filters that translate points do no harm.
 * @warning A block has at most 2^31 - 1 points; a larger one is an error and not rendered.
 * @warning Where memory runs out, one error is reported for the input and nothing of it is
 * rendered; each later frame tries again.
 *
 * @sa vtkPointGaussianMapper
 */
#ifndef vtkIsopointSplatMapper_h
#define vtkIsopointSplatMapper_h

#include "vtkOpenGLPolyDataMapper.h"
#include "vtkScatteredIsopointRenderingModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class vtkCompositeDataDisplayAttributes;

class VTKSCATTEREDISOPOINTRENDERING_EXPORT vtkIsopointSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkIsopointSplatMapper* New();
  vtkTypeMacro(vtkIsopointSplatMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the point array of radii: one component, in the units of the points' coordinates. If
   * the input has no such array, or the name is empty, Radius is used. Default: "Radius".
   */
  vtkSetStringMacro(RadiusArrayName);
  vtkGetStringMacro(RadiusArrayName);
  ///@}

  ///@{
  /**
   * Radius of all splats of input without an array of radii, in the units of the points'
   * coordinates. 0: twice the diagonal of the bounding box, divided by the square root of the
   * number of points, which suits points spread over a surface of the diagonal's square. Range: 0
   * or more. Default: 0.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on all radii and half-axes, without unit. Range: 0 or more. Default: 1.
   */
  vtkSetClampMacro(RadiusScale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * Depth behind the nearest splat within which other splats are blended with it, in radii. If it
   * is too small, splats of one surface hide each other's rims; if it is too large, separate
   * surfaces are mixed. Range: 0 or more. Default: 1.
   */
  vtkSetClampMacro(BlendDepth, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(BlendDepth, double);
  ///@}

  enum SplatShape
  {
    CIRCLE = 0,
    ELLIPSE = 1
  };

  ///@{
  /**
   * Shape of the splats: CIRCLE for disks of the points' radii, ELLIPSE for ellipses of the arrays
   * of half-axes, and disks where there are none. Default: ELLIPSE.
   */
  vtkSetClampMacro(Shape, int, CIRCLE, ELLIPSE);
  vtkGetMacro(Shape, int);
  void SetShapeToCircle() { this->SetShape(CIRCLE); }
  void SetShapeToEllipse() { this->SetShape(ELLIPSE); }
  ///@}

  ///@{
  /**
   * Names of the point arrays of half-axes: vectors of three components in the splat's plane, in
   * the units of the points' coordinates. Default: "SplatAxis1" and "SplatAxis2".
   */
  vtkSetStringMacro(SplatAxis1ArrayName);
  vtkGetStringMacro(SplatAxis1ArrayName);
  vtkSetStringMacro(SplatAxis2ArrayName);
  vtkGetStringMacro(SplatAxis2ArrayName);
  ///@}

  ///@{
  /**
   * Name of the point array of clipping planes of single splats, which vtkScatteredIsopointFilter
   * computes at creases: floating-point numbers a, b, c, d, e. Of the splat of a point q only the
   * points p with (a, b, c) . (p - q) + d >= 0 are rendered, in the units of the points'
   * coordinates. The face across the crease is on the side of the splat that its normal points to
   * if e > 0, otherwise on the other side, as it is if the array has four components. Where that
   * face hides the splat, the two are not blended, even if the splat does not extend to its plane.
   * A splat is not clipped if a, b, c and d are all 0, or one of them is not finite, nor is any if
   * the input has no such array or the name is empty. Default: "SplatClip".
   */
  vtkSetStringMacro(SplatClipArrayName);
  vtkGetStringMacro(SplatClipArrayName);
  ///@}

  ///@{
  /**
   * Level of detail: about one splat in Stride is rendered, and at most four. Each is the middle
   * one of that many neighbors on one sheet of the surface, and grows until it covers them: where
   * all splats leave no hole, neither do these. The choice is the same at each frame. Meant for
   * interaction: the first frame after a change sorts all splats, O(n log(n)), and uploads indices
   * and sizes to the graphics card. Range: 1 or more. Default: 1, all splats.
   */
  vtkSetClampMacro(Stride, int, 1, VTK_INT_MAX);
  vtkGetMacro(Stride, int);
  ///@}

  ///@{
  /**
   * Whether ghost points marked as DUPLICATEPOINT are blended with the splats of other points, and
   * seen and selected nowhere else: where several ranks render parts of one surface, each pixel has
   * the same color on all ranks that draw it. If off, they are not drawn, and neither are they with
   * a Stride above 1. Default: off.
   */
  vtkSetMacro(BlendGhosts, vtkTypeBool);
  vtkGetMacro(BlendGhosts, vtkTypeBool);
  vtkBooleanMacro(BlendGhosts, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Number of layers of a translucent surface that are rendered, the nearest first. Each takes the
   * time of an opaque surface and 36 bytes per pixel of graphics memory; empty layers take little
   * time. Range: 1 to 32. Default: 8.
   */
  vtkSetClampMacro(MaximumNumberOfLayers, int, 1, 32);
  vtkGetMacro(MaximumNumberOfLayers, int);
  ///@}

  ///@{
  /**
   * Visibilities and colors of the blocks of composite input, as in vtkCompositePolyDataMapper2: a
   * block's color replaces scalar colors and the material's color, and blocks inherit the
   * attributes of the innermost block around them that has any. Opacities and pickabilities are
   * ignored. Default: none, all blocks visible and without colors of their own.
   */
  void SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes* attributes);
  vtkCompositeDataDisplayAttributes* GetCompositeDataDisplayAttributes();
  ///@}

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  bool HasTranslucentPolygonalGeometry() override;
  void ShallowCopy(vtkAbstractMapper* mapper) override;
  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp* prop) override;

protected:
  vtkIsopointSplatMapper();
  ~vtkIsopointSplatMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void ComputeBounds() override;
  void UpdateBufferObjects(vtkRenderer*, vtkActor*) override {} // RenderPiece has done so
  void UpdateMaximumPointCellIds(vtkRenderer* renderer, vtkActor* actor) override;

  ///@{
  /**
   * In the superclass's fragment shader, the blended surface replaces interpolated vertices.
   */
  bool GetNeedToRebuildShaders(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderRenderPass(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
    vtkActor* actor, bool prePass) override;
  void ReplaceShaderColor(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderEdges(std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*) override
  {
  }
  void ReplaceShaderTCoord(std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*) override
  {
  }
  void ReplaceShaderClip(std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*) override {}
  void ReplaceShaderPrimID(std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*) override
  {
  }
  void ReplaceShaderNormal(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPicking(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPositionVC(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderCoincidentOffset(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderDepth(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  ///@}

  char* RadiusArrayName;
  char* SplatAxis1ArrayName;
  char* SplatAxis2ArrayName;
  char* SplatClipArrayName;
  double Radius = 0.0;
  double RadiusScale = 1.0;
  double BlendDepth = 1.0;
  int Shape = ELLIPSE;
  int Stride = 1;
  int MaximumNumberOfLayers = 8;
  vtkTypeBool BlendGhosts = 0;

private:
  vtkIsopointSplatMapper(const vtkIsopointSplatMapper&) = delete;
  void operator=(const vtkIsopointSplatMapper&) = delete;

  void UseWindow(vtkWindow* window);
  void ReleaseSplats();

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
