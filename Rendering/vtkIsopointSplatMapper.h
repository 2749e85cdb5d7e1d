// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointSplatMapper
 * @brief   draws points with normals and radii as one lit surface
 *
 * Each point is a splat: a disk or an ellipse in the plane orthogonal to its normal. What overlaps
 * within BlendDepth of the visible surface is blended by weights that fall from a splat's centre to
 * its rim, normals, depth and colors alike, and the blended surface is lit once at every pixel. The
 * result looks like a smooth mesh rather than like points (Zwicker et al., Surface Splatting, 2001;
 * Botsch et al., High-Quality Surface Splatting on Today's GPUs, 2005).
 *
 * Input is vtkPolyData, or a composite data set of them (SetInputDataObject or
 * SetInputConnection): all its points are drawn, whatever its cells, but for hidden and duplicated
 * ghost points and points of a position or radius that is not finite. The points' normals are the
 * active normals; without any the splats face the camera, and a warning says so once. Radii come
 * from the array RadiusArrayName, half-axes of ellipses from SplatAxis1ArrayName and
 * SplatAxis2ArrayName, planes at which splats end from SplatClipArrayName, as
 * vtkScatteredIsopointFilter writes them.
 *
 * Lights, materials, physically based rendering, scalar coloring, opacity, clipping planes,
 * transforms of the actor, face culling, a back face property, SSAO, FXAA, depth peeling,
 * order-independent translucency, shadows, sub-viewports and hardware selection work as for a
 * mesh: the blended surface passes through the fragment shader that vtkOpenGLPolyDataMapper
 * composes, user replacements and all. Textures of the actor are not applied. A translucent surface
 * shows up to MaximumNumberOfLayers of its layers, with depth peeling and without.
 *
 * A hardware selection finds the splat that is seen at a pixel: among those that reach it at the
 * visible surface, the one whose centre is nearest, in radii. Selecting cells gives the points'
 * vertex cells.
 *
 * @warning Composite input is colored by coordinates in a color map
 * (InterpolateScalarsBeforeMapping) only where each block has the array.
 * @warning Filters that turn or scale points leave arrays of radii, axes and planes as they were:
 * turn or scale the actor instead. Those that translate points need not change them.
 * @warning A block has at most 2^31 - 1 points; larger ones are an error and not drawn.
 * @warning Input that memory runs out for is one error and not drawn, until there is enough.
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
   * Name of the point array of radii, in the units of the points' coordinates. Where the input has
   * no such array of one component, Radius is taken. Default: "Radius".
   */
  vtkSetStringMacro(RadiusArrayName);
  vtkGetStringMacro(RadiusArrayName);
  ///@}

  ///@{
  /**
   * Radius of splats that have none, in the units of the points' coordinates; 0: one that suits
   * points spread over a surface as large as the bounding box's diagonal is long, squared: twice
   * that diagonal by the square root of the number of points. At least 0. Default: 0.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on all radii and half-axes. At least 0. Default: 1.
   */
  vtkSetClampMacro(RadiusScale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * How far behind the nearest splat others still blend with it, in radii. Too little lets splats
   * of one surface hide each other's edges, too much mixes separate surfaces. At least 0.
   * Default: 1.
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
   * Shape of the splats: CIRCLE draws disks of the points' radii, ELLIPSE takes the arrays of
   * half-axes and draws disks where there are none. Default: ELLIPSE.
   */
  vtkSetClampMacro(Shape, int, CIRCLE, ELLIPSE);
  vtkGetMacro(Shape, int);
  void SetShapeToCircle() { this->SetShape(CIRCLE); }
  void SetShapeToEllipse() { this->SetShape(ELLIPSE); }
  ///@}

  ///@{
  /**
   * Names of the point arrays of half-axes: vectors in the splat's plane, in the units of the
   * points' coordinates. Default: "SplatAxis1" and "SplatAxis2".
   */
  vtkSetStringMacro(SplatAxis1ArrayName);
  vtkGetStringMacro(SplatAxis1ArrayName);
  vtkSetStringMacro(SplatAxis2ArrayName);
  vtkGetStringMacro(SplatAxis2ArrayName);
  ///@}

  ///@{
  /**
   * Name of the point array of planes at which splats end, as vtkScatteredIsopointFilter writes it
   * for the sake of sharp edges: floating-point numbers a, b, c, d, e; of the splat of a point q
   * only the places p with (a, b, c) . (p - q) + d >= 0 are drawn, in the units of the points'
   * coordinates. A plane that the splat does not reach cuts nothing off, but still keeps it from
   * blending with a face before it, on the plane's other side. That face is on the side of the splat
   * that its normal points to if e is positive, and on the other if it is not, or if the array has
   * four components, without e. Splats whose a, b, c, d are zeros or not finite are drawn whole;
   * where the input has no such array, and where the name is empty, all are.
   * Default: "SplatClip".
   */
  vtkSetStringMacro(SplatClipArrayName);
  vtkGetStringMacro(SplatClipArrayName);
  ///@}

  ///@{
  /**
   * Level of detail: one splat in Stride is drawn, chosen at random but always the same, its radius
   * times the square root of Stride. Meant for the time of an interaction: a change of it sends
   * nothing to the graphics card again. At least 1. Default: 1, all splats.
   */
  vtkSetClampMacro(Stride, int, 1, VTK_INT_MAX);
  vtkGetMacro(Stride, int);
  ///@}

  ///@{
  /**
   * How many layers of a translucent surface are drawn, nearest first. Each costs as much as an
   * opaque surface and 36 bytes a pixel; those that nothing is seen of cost little. From 1 to 32.
   * Default: 8.
   */
  vtkSetClampMacro(MaximumNumberOfLayers, int, 1, 32);
  vtkGetMacro(MaximumNumberOfLayers, int);
  ///@}

  ///@{
  /**
   * Visibilities and colors of the blocks of composite input, as vtkCompositePolyDataMapper2 takes
   * them: a block's color replaces scalar colors and the material's; what is said of a block holds
   * for those in it of which nothing is said. Opacities and pickabilities are not looked at.
   * Default: none.
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
   * The blended surface takes the place of interpolated vertices in the superclass's shader.
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

private:
  vtkIsopointSplatMapper(const vtkIsopointSplatMapper&) = delete;
  void operator=(const vtkIsopointSplatMapper&) = delete;

  void UseWindow(vtkWindow* window);
  void ReleaseSplats();

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
