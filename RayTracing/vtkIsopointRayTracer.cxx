// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointRayTracer.h"

#include "Core/Base/Threads.h"
#include "vtkIsopointTracedDisplay.h"
#include "vtkIsopointTracedScene.h"
#include "vtkIsopointTracedView.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkLightsPass.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOverlayPass.h"
#include "vtkPropCollection.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkSmartPointer.h"
#include "vtkTexture.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIsopointRayTracer);

namespace
{

/// A pass within the camera's pass that calls a function.
class vtkIsopointFunctionPass : public vtkRenderPass
{
public:
  static vtkIsopointFunctionPass* New();
  vtkTypeMacro(vtkIsopointFunctionPass, vtkRenderPass);
  void Render(const vtkRenderState* state) override { this->Function(state); }

  std::function<void(const vtkRenderState*)> Function;
};
vtkStandardNewMacro(vtkIsopointFunctionPass);

/// A part of a picture, in pixels from the lower left.
struct Tile
{
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t width = 0;
  std::size_t height = 0;
};

/// The length of an offset along a direction, as a share of the direction's length.
double shareOf(
  const isopoint::Vector& from, const isopoint::Vector& to, const isopoint::Vector& direction)
{
  return isopoint::dot(isopoint::operator-(to, from), direction) /
         isopoint::dot(direction, direction);
}

/// Whether a window is part of another one, up to a small part of a pixel. Grabbing the picture of
/// a window changes the camera's angle and restores it inexactly.
/// @param x, y, width, height as shares of the other window
bool isWindowPart(const raytracing::Window& part, const raytracing::Window& whole, double x,
  double y, double width, double height)
{
  constexpr double most = 1e-6; // of the window's width and height
  const isopoint::Vector corner = whole.at(x, y);
  double size = 0.0;
  double difference = 0.0;
  for (std::size_t axis = 0; axis < corner.size(); ++axis)
  {
    const double right = width * whole.right[axis];
    const double up = height * whole.up[axis];
    size = std::max({ size, std::abs(right), std::abs(up) });
    difference = std::max({ difference, std::abs(corner[axis] - part.corner[axis]),
      std::abs(right - part.right[axis]), std::abs(up - part.up[axis]) });
  }
  return difference <= most * size;
}

/// Finds what a camera with a window of this size sees of a picture.
/// @returns whether that is the picture or a tile of it
bool findTile(const raytracing::Camera& camera, const int* size, const raytracing::Picture& picture,
  const raytracing::Camera& whole, Tile& tile)
{
  const double width = picture.getWidth();
  const double height = picture.getHeight();
  const double column = std::round(
    width * shareOf(whole.nearWindow.corner, camera.nearWindow.corner, whole.nearWindow.right));
  const double row = std::round(
    height * shareOf(whole.nearWindow.corner, camera.nearWindow.corner, whole.nearWindow.up));
  if (!(column >= 0.0 && row >= 0.0 && column + size[0] <= width && row + size[1] <= height))
  {
    return false;
  }
  tile = { static_cast<std::size_t>(column), static_cast<std::size_t>(row),
    static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]) };
  const auto isPartOf = [&](const raytracing::Window& part, const raytracing::Window& window)
  {
    return isWindowPart(
      part, window, column / width, row / height, size[0] / width, size[1] / height);
  };
  return isPartOf(camera.nearWindow, whole.nearWindow) &&
         isPartOf(camera.farWindow, whole.farWindow);
}

std::vector<vtkActor*> tracedActorsOf(vtkRenderer* renderer)
{
  std::vector<vtkActor*> actors;
  vtkCollectionSimpleIterator iterator;
  renderer->GetViewProps()->InitTraversal(iterator);
  while (vtkProp* const prop = renderer->GetViewProps()->GetNextProp(iterator))
  {
    if (vtkIsTraced(prop))
    {
      actors.push_back(vtkActor::SafeDownCast(prop));
    }
  }
  return actors;
}

/// Describes everything except the camera that changes the picture.
std::string stateOf(const vtkIsopointTracedView& view, vtkRenderer* renderer)
{
  vtkIsopointTracedState state;
  const auto addVectors = [&state](const std::vector<raytracing::Vector>& vectors)
  {
    for (const raytracing::Vector& vector : vectors)
    {
      state.Add(vector.x, vector.y, vector.z);
    }
  };
  for (const raytracing::Light& light : view.Lights)
  {
    addVectors({ light.position, light.towards, light.diffuse, light.specular, light.attenuation });
    state.Add(light.isPositional, light.coneCosine, light.exponent, light.extent);
  }
  addVectors({ view.Environment.bottom, view.Environment.top });
  state.Add(renderer->GetTexturedBackground());
  for (vtkTexture* const texture :
    { renderer->GetBackgroundTexture(), renderer->GetEnvironmentTexture() })
  {
    state.Add(texture, texture ? texture->GetMTime() : 0);
  }
  return state.Get();
}

} // namespace

class vtkIsopointRayTracer::Internals
{
public:
  Internals()
  {
    this->CameraPass->SetDelegatePass(this->InnerPass);
    vtkNew<vtkRenderPassCollection> passes;
    vtkNew<vtkLightsPass> lights;
    vtkNew<vtkOpaquePass> opaque;
    vtkNew<vtkTranslucentPass> translucent;
    vtkNew<vtkVolumetricPass> volumetric;
    vtkNew<vtkOverlayPass> overlay;
    passes->AddItem(lights);
    passes->AddItem(opaque);
    passes->AddItem(translucent);
    passes->AddItem(volumetric);
    passes->AddItem(overlay);
    this->OtherPasses->SetPasses(passes);
  }

  /// Updates the picture for a renderer.
  /// @param samples maximum number to add
  /// @returns whether the picture is complete
  bool Trace(vtkIsopointRayTracer* self, vtkRenderer* renderer,
    const std::vector<vtkActor*>& actors, const int* size, int samples);

  /// Traces and draws the props of a state.
  void RenderTraced(vtkIsopointRayTracer* self, const vtkRenderState* state);
  void Draw(vtkOpenGLRenderWindow* window);
  /// Writes the visible pixels in front of the background.
  void Write(const int* size, vtkImageData* image) const;

  /// The index in the picture of a visible pixel.
  std::size_t IndexOf(std::size_t column, std::size_t row) const
  {
    return (this->Shown.row + row) * this->Picture->getWidth() + this->Shown.column + column;
  }

  vtkNew<vtkCameraPass> CameraPass;
  vtkNew<vtkIsopointFunctionPass> InnerPass;
  vtkNew<vtkSequencePass> OtherPasses; // of props that are not traced
  vtkIsopointTracedDisplay Display;
  vtkIsopointTracedScene Scene;
  std::unique_ptr<vtkIsopointTracedView> View;
  std::unique_ptr<raytracing::Picture> Picture;
  std::string PictureState;
  raytracing::Camera PictureCamera;
  Tile Shown; // part of the picture
};

bool vtkIsopointRayTracer::Internals::Trace(vtkIsopointRayTracer* self, vtkRenderer* renderer,
  const std::vector<vtkActor*>& actors, const int* size, int samples)
{
  self->AbortExecute = 0;
  const bool isNewScene = this->Scene.Update(actors, self->AbsorptionDistance);
  const double aspect = static_cast<double>(size[0]) / size[1];
  this->View = std::make_unique<vtkIsopointTracedView>(
    renderer, aspect, self->LightAngle, this->Scene.GetFrame());

  raytracing::Illuminants illuminants;
  illuminants.lights = this->View->Lights;
  illuminants.environment = this->View->Environment;
  const auto ambient = static_cast<float>(self->AmbientLight);
  illuminants.ambient.color = { ambient, ambient, ambient };
  illuminants.ambient.distance = static_cast<float>(self->AmbientDistance);
  illuminants.hasShadows = self->Shadows != 0;
  illuminants.maxBounces = self->MaximumNumberOfBounces;

  vtkRenderWindow* const window = renderer->GetRenderWindow();
  isopoint::Execution execution;
  isopoint::useThreads(execution, self->NumberOfThreads > 0
                                    ? static_cast<std::size_t>(self->NumberOfThreads)
                                    : isopoint::availableThreadsOfRank());
  execution.progress = [self](double share)
  { self->InvokeEvent(vtkCommand::ProgressEvent, &share); };
  execution.isAborted = [self, window]()
  { return self->AbortExecute || (window && window->CheckAbortStatus()); };
  vtkIsopointTracedState state;
  state.Add(stateOf(*this->View, renderer), self->SamplesPerPixel, self->AmbientLight,
    self->AmbientDistance, self->Shadows, self->MaximumNumberOfBounces);
  if (isNewScene || !this->Picture || this->PictureState != state.Get() ||
      !findTile(this->View->Camera, size, *this->Picture, this->PictureCamera, this->Shown))
  {
    this->Picture.reset();
    this->Picture = std::make_unique<raytracing::Picture>(static_cast<std::uint32_t>(size[0]),
      static_cast<std::uint32_t>(size[1]), static_cast<std::uint32_t>(self->SamplesPerPixel));
    this->Picture->findDistances(execution, this->View->Camera, this->Scene.Get());
    this->PictureState = state.Get();
    this->PictureCamera = this->View->Camera;
    this->Shown = { 0, 0, this->Picture->getWidth(), this->Picture->getHeight() };
  }
  const raytracing::PathTracer tracer(this->Scene.Get(), illuminants);
  const bool isDone = this->Picture->addSamples(execution, this->PictureCamera, tracer,
    this->Picture->getSamples() + static_cast<std::uint32_t>(samples));
  self->NumberOfSamples = static_cast<int>(this->Picture->getSamples());
  return isDone;
}

void vtkIsopointRayTracer::Internals::RenderTraced(
  vtkIsopointRayTracer* self, const vtkRenderState* state)
{
  vtkRenderer* const renderer = state->GetRenderer();
  // Actors out of view also cast shadows and are reflected.
  const std::vector<vtkActor*> traced = tracedActorsOf(renderer);
  std::vector<vtkProp*> others;
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    vtkProp* const prop = state->GetPropArray()[i];
    if (std::find(traced.begin(), traced.end(), prop) == traced.end())
    {
      others.push_back(prop);
    }
  }
  const auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  if (!traced.empty() && size[0] > 0 && size[1] > 0)
  {
    const int samples = self->SamplesPerFrame > 0 ? self->SamplesPerFrame : self->SamplesPerPixel;
    this->Trace(self, renderer, traced, size, samples);
    this->Draw(window);
  }
  vtkRenderState rest(renderer);
  rest.SetPropArrayAndCount(others.data(), static_cast<int>(others.size()));
  rest.SetFrameBuffer(state->GetFrameBuffer());
  this->OtherPasses->Render(&rest);
}

void vtkIsopointRayTracer::Internals::Draw(vtkOpenGLRenderWindow* window)
{
  const std::size_t width = this->Shown.width;
  const std::size_t height = this->Shown.height;
  std::vector<float> colors(4 * width * height);
  std::vector<float> depths(width * height);
  for (std::size_t row = 0; row < height; ++row)
  {
    const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(height);
    for (std::size_t column = 0; column < width; ++column)
    {
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(width);
      const std::size_t i = row * width + column;
      const std::size_t traced = this->IndexOf(column, row);
      const raytracing::Radiance pixel = this->Picture->pixel(traced);
      const float values[4] = { pixel.color.x, pixel.color.y, pixel.color.z, pixel.alpha };
      std::copy(values, values + 4, &colors[4 * i]);
      depths[i] = static_cast<float>(this->View->GetDepth(x, y, this->Picture->distance(traced)));
    }
  }
  this->Display.Draw(window, static_cast<int>(width), static_cast<int>(height), colors, depths);
}

void vtkIsopointRayTracer::Internals::Write(const int* size, vtkImageData* image) const
{
  image->SetDimensions(size[0], size[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      const raytracing::Radiance pixel = this->Picture->pixel(
        this->IndexOf(static_cast<std::size_t>(x), static_cast<std::size_t>(y)));
      const raytracing::Color background =
        this->View->Environment.behind((static_cast<float>(x) + 0.5f) / static_cast<float>(size[0]),
          (static_cast<float>(y) + 0.5f) / static_cast<float>(size[1]));
      const raytracing::Color color = pixel.color + (1.0f - pixel.alpha) * background;
      for (const float value : { color.x, color.y, color.z })
      {
        *bytes++ = static_cast<unsigned char>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
      }
    }
  }
}

vtkIsopointRayTracer::vtkIsopointRayTracer()
  : Internal(std::make_unique<Internals>())
{
}

vtkIsopointRayTracer::~vtkIsopointRayTracer() = default;

bool vtkIsopointRayTracer::Safely(const std::function<void()>& work)
{
  try
  {
    work();
    return true;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory: the scene is not traced. Show fewer points, or make the picture "
                  "smaller.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("The scene is not traced: " << error.what());
  }
  this->Internal->Scene.Clear();
  this->Internal->Picture.reset();
  return false;
}

void vtkIsopointRayTracer::Render(const vtkRenderState* state)
{
  vtkRenderer* const renderer = state->GetRenderer();
  if (renderer->GetSelector())
  {
    // VTK's own passes do not tell a selector which prop they draw; a renderer without a pass does.
    const vtkSmartPointer<vtkIsopointRayTracer> self = this;
    renderer->SetPass(nullptr);
    renderer->DeviceRender();
    renderer->SetPass(this);
    return;
  }
  this->Internal->InnerPass->Function = [this](const vtkRenderState* inner)
  { this->Safely([&]() { this->Internal->RenderTraced(this, inner); }); };
  this->Internal->CameraPass->Render(state);
  this->NumberOfRenderedProps = this->Internal->CameraPass->GetNumberOfRenderedProps();
}

bool vtkIsopointRayTracer::RenderToImage(
  vtkRenderer* renderer, int width, int height, vtkImageData* image)
{
  if (!renderer || !image)
  {
    vtkErrorMacro("There is no renderer or no image: give both.");
    return false;
  }
  int size[2] = { width, height };
  if ((width <= 0 || height <= 0) && renderer->GetRenderWindow())
  {
    int origin[2];
    renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  }
  constexpr int most = 65536;
  if (size[0] <= 0 || size[1] <= 0 || size[0] > most || size[1] > most)
  {
    vtkErrorMacro("A picture of " << size[0] << " x " << size[1]
                                  << " pixels cannot be traced: choose 1 to " << most << ".");
    return false;
  }
  bool isDone = false;
  const auto trace = [&]()
  {
    isDone =
      this->Internal->Trace(this, renderer, tracedActorsOf(renderer), size, this->SamplesPerPixel);
    if (isDone)
    {
      this->Internal->Write(size, image);
    }
  };
  return this->Safely(trace) && isDone;
}

void vtkIsopointRayTracer::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Display.ReleaseGraphicsResources(window);
  this->Internal->CameraPass->ReleaseGraphicsResources(window);
  this->Internal->OtherPasses->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkIsopointRayTracer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplesPerPixel: " << this->SamplesPerPixel << '\n'
     << indent << "SamplesPerFrame: " << this->SamplesPerFrame << '\n'
     << indent << "Shadows: " << this->Shadows << '\n'
     << indent << "LightAngle: " << this->LightAngle << '\n'
     << indent << "AmbientLight: " << this->AmbientLight << '\n'
     << indent << "AmbientDistance: " << this->AmbientDistance << '\n'
     << indent << "MaximumNumberOfBounces: " << this->MaximumNumberOfBounces << '\n'
     << indent << "AbsorptionDistance: " << this->AbsorptionDistance << '\n'
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n'
     << indent << "AbortExecute: " << this->AbortExecute << '\n'
     << indent << "NumberOfSamples: " << this->NumberOfSamples << '\n';
}
