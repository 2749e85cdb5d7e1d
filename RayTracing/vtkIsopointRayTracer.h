// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkIsopointRayTracer
 * @brief   traces rays to surfaces
 *
 * A render pass (vtkRenderer::SetPass) that traces what the renderer's actors show, and a picture
 * without a window (RenderToImage). Actors with polygons or triangle strips that are shown as
 * surfaces are traced, those with a vtkIsopointSplatMapper among them, with interpolated normals,
 * scalar colors, blocks and transforms as the mapper draws them. What else the renderer shows
 * (lines, points, text, volumes, annotations) is drawn by VTK over the picture, hidden where traced
 * surfaces are in front of it; RenderToImage() leaves it out. All actors are drawn by VTK for a
 * hardware selection. A window that shows a part of the last picture, as where a large picture is
 * grabbed in tiles, is not traced again.
 *
 * Lights are the renderer's, with shadows. The background is the renderer's color, gradient
 * or texture; what is reflected and refracted sees it as a panorama around the camera, or the
 * renderer's environment texture, if it has one in longitudes and latitudes.
 *
 * Materials are those of vtkProperty:
 * - Flat, Gouraud and Phong interpolation: ambient, diffuse and specular light as in VTK. What is
 *   not opaque lets light pass straight.
 * - Physically based interpolation (SetInterpolationToPBR): a surface that reflects what is around
 *   it, sharply or, with Roughness, blurred. With Metallic 1 it reflects in its Color: a mirror.
 *   With Metallic 0 it reflects as Fresnel's equations say for BaseIOR, and where Opacity is
 *   below 1 it refracts what it does not reflect: with Opacity 0 it is glass, which takes on its
 *   Color over AbsorptionDistance. Its normals may point to either side; the surface is to be
 *   closed.
 *
 * Colors are those of the display throughout, as in VTK without physically based rendering. A
 * picture is the same to the last bit for any number of threads.
 *
 * @warning Textures of actors, interpolation of scalars before mapping, mappers' clipping planes,
 * face culling, back face properties, and assemblies are not considered.
 * @warning Positions are resolved to 1e-7 of the diagonal of all that is traced: leave out a floor
 * that is many thousand times as large as the splats' surface.
 *
 * @sa vtkIsopointSplatMapper
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
   * Samples of each pixel, which determine how smooth outlines, soft shadows and blurred
   * reflections are. Range: 1 to 65536. Default: 16.
   */
  vtkSetClampMacro(SamplesPerPixel, int, 1, 65536);
  vtkGetMacro(SamplesPerPixel, int);
  ///@}

  ///@{
  /**
   * Samples that each frame of a window adds until there are SamplesPerPixel; a change of what is
   * shown begins again. 0: all in one frame. Range: 0 to 65536. Default: 0.
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
   * Angle under which lights are seen, in degrees, of positional lights from their focal points:
   * the larger it is, the softer shadows are. 0: shadows are sharp. Range: 0 to 90. Default: 1.
   */
  vtkSetClampMacro(LightAngle, double, 0.0, 90.0);
  vtkGetMacro(LightAngle, double);
  ///@}

  ///@{
  /**
   * Light from all directions, as a factor on the color of surfaces that are not mirrors or glass.
   * The ambient light of vtkProperty is added. Range: 0 or more. Default: 0.
   */
  vtkSetClampMacro(AmbientLight, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientLight, double);
  ///@}

  ///@{
  /**
   * Distance within which surfaces take away ambient light from each other (ambient occlusion), as
   * a share of the diagonal of all that is shown. 0: none do. Range: 0 or more. Default: 0.1.
   */
  vtkSetClampMacro(AmbientDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientDistance, double);
  ///@}

  ///@{
  /**
   * Reflections and refractions along a path, after which no light arrives. Range: 0 to 64.
   * Default: 8.
   */
  vtkSetClampMacro(MaximumNumberOfBounces, int, 0, 64);
  vtkGetMacro(MaximumNumberOfBounces, int);
  ///@}

  ///@{
  /**
   * Distance within which light takes on the color of the glass that it passes, in the units of the
   * world. 0: the diagonal of the actor's bounds. Range: 0 or more. Default: 0.
   */
  vtkSetClampMacro(AbsorptionDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AbsorptionDistance, double);
  ///@}

  ///@{
  /**
   * Threads that trace rays, at most. 0: one for each core that the process may use. Range: 0 to
   * 1024. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Ends the tracing that is under way within a fraction of a second; it is to be set in an
   * observer of ProgressEvent, which has the share that is done, and is off again when the next one
   * begins. An abort of the render window does the same. The frame shows the samples so far.
   * Default: off.
   */
  vtkSetMacro(AbortExecute, vtkTypeBool);
  vtkGetMacro(AbortExecute, vtkTypeBool);
  vtkBooleanMacro(AbortExecute, vtkTypeBool);
  ///@}

  /**
   * Samples that each pixel of the last picture has.
   */
  vtkGetMacro(NumberOfSamples, int);

  /**
   * Traces a renderer's actors, as its active camera sees them, to a picture of three bytes per
   * pixel. It needs neither window nor OpenGL. The camera's clipping range is used as it is.
   * @param width, height of the picture in pixels, 1 to 65536; 0 or less: those of the renderer in
   * its window
   * @returns whether there is a picture: not after an abort nor an error, such as a lack of memory
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

  /// Does work, and reports what it throws. @returns whether it was done
  bool Safely(const std::function<void()>& work);

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
