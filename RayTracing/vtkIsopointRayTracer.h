// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointRayTracer
 * @brief   renders surfaces by ray tracing
 *
 * A render pass (vtkRenderer::SetPass) that traces the actors of a renderer; RenderToImage() needs
 * no window. It traces actors with polygons or triangle strips shown as surfaces, including those
 * with a vtkIsopointSplatMapper, with interpolated normals, scalar colors, blocks and transforms as
 * their mapper draws them. VTK draws everything else (lines, points, text, volumes, annotations)
 * over the picture, hidden behind traced surfaces; RenderToImage() omits it. For a hardware
 * selection VTK draws all actors. A window that shows part of the last picture is not traced again,
 * for example when a large picture is grabbed in tiles.
 *
 * Lights are the renderer's, with shadows. The background is the renderer's color, gradient or
 * texture. Reflections and refractions show it as a panorama around the camera, or show the
 * renderer's environment texture, if it has one in longitudes and latitudes.
 *
 * Materials are those of vtkProperty:
 * - Flat, Gouraud and Phong interpolation: ambient, diffuse and specular light as in VTK. Light
 *   passes straight through translucent surfaces.
 * - Physically based interpolation (SetInterpolationToPBR): a surface that reflects its
 *   surroundings, sharply or, with Roughness, blurred. With Metallic 1 it is a mirror that reflects
 *   in its Color. With Metallic 0 it reflects by Fresnel's equations for BaseIOR and, with Opacity
 *   below 1, refracts the rest: with Opacity 0 it is glass, which tints light with its Color over
 *   AbsorptionDistance. The surface must be closed; its normals may point to either side.
 *
 * Colors are display colors throughout, as in VTK without physically based rendering. Pictures are
 * the same to the last bit for any number of threads.
 *
 * @warning
 * Ignored: textures of actors, interpolation of scalars before mapping, clipping planes of mappers,
 * face culling, back face properties, and assemblies.
 * @warning
 * Positions are resolved to 1e-7 of the diagonal of everything traced: avoid a floor many thousand
 * times as large as the surface of splats.
 *
 * @sa
 * vtkIsopointSplatMapper
 */
#ifndef vtkIsopointRayTracer_h
#define vtkIsopointRayTracer_h

#include "vtkRenderPass.h"
#include "vtkScatteredIsopointRayTracingModule.h" // for the export macro

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr

class vtkImageData;
class vtkRenderer;

class VTKSCATTEREDISOPOINTRAYTRACING_EXPORT vtkIsopointRayTracer : public vtkRenderPass
{
public:
  static vtkIsopointRayTracer* New();
  vtkTypeMacro(vtkIsopointRayTracer, vtkRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Samples per pixel, for smooth outlines, soft shadows and blurred reflections. Range: 1 to
   * 65536. Default: 16.
   */
  vtkSetClampMacro(SamplesPerPixel, int, 1, 65536);
  vtkGetMacro(SamplesPerPixel, int);
  ///@}

  ///@{
  /**
   * Samples that each frame of a window adds until there are SamplesPerPixel. A changed scene
   * starts again. 0: all in one frame. Range: 0 to 65536. Default: 0.
   */
  vtkSetClampMacro(SamplesPerFrame, int, 0, 65536);
  vtkGetMacro(SamplesPerFrame, int);
  ///@}

  ///@{
  /**
   * Whether surfaces cast shadows. Default: on.
   */
  vtkSetMacro(Shadows, vtkTypeBool);
  vtkGetMacro(Shadows, vtkTypeBool);
  vtkBooleanMacro(Shadows, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The apparent angle of lights, in degrees (for positional lights, from their focal points).
   * Larger angles soften shadows; 0 makes them sharp. Range: 0 to 90. Default: 1.
   */
  vtkSetClampMacro(LightAngle, double, 0.0, 90.0);
  vtkGetMacro(LightAngle, double);
  ///@}

  ///@{
  /**
   * Light from all directions, as a factor on the color of surfaces other than mirrors and glass.
   * The ambient light of vtkProperty is added. Range: 0 or more. Default: 0.
   */
  vtkSetClampMacro(AmbientLight, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientLight, double);
  ///@}

  ///@{
  /**
   * The distance within which surfaces block ambient light (ambient occlusion), as a share of the
   * diagonal of everything shown. 0: none do. Range: 0 or more. Default: 0.1.
   */
  vtkSetClampMacro(AmbientDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientDistance, double);
  ///@}

  ///@{
  /**
   * The maximum number of reflections and refractions along a path; then no light arrives. Range: 0
   * to 64. Default: 8.
   */
  vtkSetClampMacro(MaximumNumberOfBounces, int, 0, 64);
  vtkGetMacro(MaximumNumberOfBounces, int);
  ///@}

  ///@{
  /**
   * The distance over which light takes on the color of glass, in world units. 0: the diagonal of
   * the actor's bounds. Range: 0 or more. Default: 0.
   */
  vtkSetClampMacro(AbsorptionDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AbsorptionDistance, double);
  ///@}

  ///@{
  /**
   * The maximum number of threads. 0: one per available core. Range: 0 to 1024. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Ends tracing within a fraction of a second. Set it in an observer of ProgressEvent, which has
   * the share done; it is reset when the next tracing begins. Aborting the render window has the
   * same effect. The frame shows the samples so far. Default: off.
   */
  vtkSetMacro(AbortExecute, vtkTypeBool);
  vtkGetMacro(AbortExecute, vtkTypeBool);
  vtkBooleanMacro(AbortExecute, vtkTypeBool);
  ///@}

  /**
   * The number of samples per pixel of the last picture.
   */
  vtkGetMacro(NumberOfSamples, int);

  /**
   * Traces a renderer's actors, seen by its active camera, to a picture of three bytes per pixel.
   * Needs neither a window nor OpenGL. Uses the camera's clipping range as is.
   * @param width, height of the picture in pixels, 1 to 65536; 0 or less: those of the renderer in
   * its window
   * @returns whether there is a picture; false after an abort or an error, such as a lack of memory
   */
  bool RenderToImage(vtkRenderer* renderer, int width, int height, vtkImageData* image);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkIsopointRayTracer();
  ~vtkIsopointRayTracer() override;

  int SamplesPerPixel = 16;
  int SamplesPerFrame = 0;
  vtkTypeBool Shadows = 1;
  double LightAngle = 1.0;
  double AmbientLight = 0.0;
  double AmbientDistance = 0.1;
  int MaximumNumberOfBounces = 8;
  double AbsorptionDistance = 0.0;
  int NumberOfThreads = 0;
  vtkTypeBool AbortExecute = 0;
  int NumberOfSamples = 0;

private:
  vtkIsopointRayTracer(const vtkIsopointRayTracer&) = delete;
  void operator=(const vtkIsopointRayTracer&) = delete;

  /// Does work, and reports exceptions. @returns whether it succeeded
  bool Safely(const std::function<void()>& work);

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
