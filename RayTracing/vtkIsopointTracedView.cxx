// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedView.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

using isopoint::operator-;

namespace
{

raytracing::Color scaledColor(double factor, const double* color)
{
  return static_cast<float>(factor) * vtkToTracedVector(color);
}

/// The pixels of a texture; empty if it has no image.
raytracing::Texture textureOf(vtkTexture* texture)
{
  raytracing::Texture result;
  if (!texture)
  {
    return result;
  }
  if (texture->GetInputAlgorithm())
  {
    texture->GetInputAlgorithm()->Update();
  }
  vtkImageData* const image = texture->GetInput();
  vtkDataArray* const pixels = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!pixels || texture->GetCubeMap())
  {
    return result;
  }
  const int* const size = image->GetDimensions();
  result.width = static_cast<std::uint32_t>(size[0]);
  result.height = static_cast<std::uint32_t>(size[1]);
  result.pixels.resize(static_cast<std::size_t>(size[0]) * size[1]);
  const double unit = pixels->GetDataType() == VTK_UNSIGNED_CHAR ? 1.0 / 255.0 : 1.0;
  const int last = pixels->GetNumberOfComponents() - 1;
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
  {
    const auto component = [&](int index)
    {
      // One or two components are gray and opacity.
      const int source = last < 2 ? 0 : index;
      return static_cast<float>(unit * pixels->GetComponent(static_cast<vtkIdType>(i), source));
    };
    result.pixels[i] = { component(0), component(1), component(2) };
  }
  return result;
}

} // namespace

vtkIsopointTracedView::vtkIsopointTracedView(
  vtkRenderer* renderer, double aspect, double lightAngle, const vtkIsopointTracedFrame& frame)
{
  this->SetCamera(renderer, aspect, frame);
  this->SetLights(renderer, lightAngle, frame);
  this->SetEnvironment(renderer, aspect);
}

void vtkIsopointTracedView::SetCamera(
  vtkRenderer* renderer, double aspect, const vtkIsopointTracedFrame& frame)
{
  vtkMatrix4x4* const worldToClip =
    renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0);
  vtkNew<vtkMatrix4x4> sceneToWorld;
  for (int axis = 0; axis < 3; ++axis)
  {
    sceneToWorld->SetElement(axis, axis, frame.Length);
    sceneToWorld->SetElement(axis, 3, frame.Center[axis]);
  }
  vtkMatrix4x4::Multiply4x4(worldToClip, sceneToWorld, this->SceneToClip);
  vtkNew<vtkMatrix4x4> clipToScene;
  vtkMatrix4x4::Invert(this->SceneToClip, clipToScene);
  const auto place = [&](double x, double y, double z)
  {
    const double clip[4] = { x, y, z, 1.0 };
    double point[4];
    clipToScene->MultiplyPoint(clip, point);
    return isopoint::Vector{ point[0] / point[3], point[1] / point[3], point[2] / point[3] };
  };
  const auto windowAt = [&](double z)
  {
    const isopoint::Vector corner = place(-1.0, -1.0, z);
    return raytracing::Window{ corner, place(1.0, -1.0, z) - corner, place(-1.0, 1.0, z) - corner };
  };
  this->Camera = { windowAt(-1.0), windowAt(1.0) };
}

void vtkIsopointTracedView::SetLights(
  vtkRenderer* renderer, double lightAngle, const vtkIsopointTracedFrame& frame)
{
  vtkLightCollection* const lights = renderer->GetLights();
  if (lights->GetNumberOfItems() == 0 && renderer->GetAutomaticLightCreation())
  {
    renderer->CreateLight();
  }
  renderer->UpdateLightsGeometryToFollowCamera();
  const double extent = std::tan(0.5 * vtkMath::RadiansFromDegrees(lightAngle));
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* const light = lights->GetNextLight(iterator))
  {
    if (!light->GetSwitch())
    {
      continue;
    }
    double from[3];
    double to[3];
    light->GetTransformedPosition(from);
    light->GetTransformedFocalPoint(to);
    double towards[3] = { from[0] - to[0], from[1] - to[1], from[2] - to[2] };
    const double distance = vtkMath::Normalize(towards);
    raytracing::Light result;
    result.diffuse = scaledColor(light->GetIntensity(), light->GetDiffuseColor());
    result.specular = scaledColor(light->GetIntensity(), light->GetSpecularColor());
    result.towards = raytracing::directionOf(vtkToTracedVector(towards));
    result.isPositional = light->GetPositional() != 0;
    result.extent = static_cast<float>(extent);
    if (result.isPositional)
    {
      const std::array<double, 3> position = frame.ToScene(from);
      result.position = vtkToTracedVector(position.data());
      result.extent *= static_cast<float>(distance / frame.Length);
      const double* const attenuation = light->GetAttenuationValues();
      const double unit = frame.Length;
      const double scaled[3] = { attenuation[0], attenuation[1] * unit,
        attenuation[2] * unit * unit };
      result.attenuation = vtkToTracedVector(scaled);
      constexpr double widestCone = 90.0; // as in VTK, wider ones shine in all directions
      if (light->GetConeAngle() < widestCone)
      {
        result.coneCosine =
          static_cast<float>(std::cos(vtkMath::RadiansFromDegrees(light->GetConeAngle())));
        result.exponent = static_cast<float>(light->GetExponent());
      }
    }
    this->Lights.push_back(result);
  }
}

void vtkIsopointTracedView::SetEnvironment(vtkRenderer* renderer, double aspect)
{
  raytracing::Environment& environment = this->Environment;
  environment.bottom = vtkToTracedVector(renderer->GetBackground());
  environment.top = renderer->GetGradientBackground()
                      ? vtkToTracedVector(renderer->GetBackground2())
                      : environment.bottom;
  if (renderer->GetTexturedBackground())
  {
    environment.background = textureOf(renderer->GetBackgroundTexture());
  }
  environment.panorama = textureOf(renderer->GetEnvironmentTexture());

  vtkCamera* const camera = renderer->GetActiveCamera();
  vtkMatrix4x4* const view = camera->GetViewTransformMatrix();
  environment.right = vtkToTracedVector(view->Element[0]);
  environment.up = vtkToTracedVector(view->Element[1]);
  environment.ahead = -vtkToTracedVector(view->Element[2]);
  const double tangent = std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  const bool isHorizontal = camera->GetUseHorizontalViewAngle() != 0;
  environment.tangentX = static_cast<float>(isHorizontal ? tangent : tangent * aspect);
  environment.tangentY = static_cast<float>(isHorizontal ? tangent / aspect : tangent);
}

double vtkIsopointTracedView::GetDepth(double x, double y, double distance) const
{
  if (!std::isfinite(distance))
  {
    return 1.0;
  }
  const isopoint::Vector origin = this->Camera.nearWindow.at(x, y);
  const isopoint::Vector offset = this->Camera.farWindow.at(x, y) - origin;
  const double scale = distance / vtkMath::Norm(offset.data());
  const double place[4] = { origin[0] + scale * offset[0], origin[1] + scale * offset[1],
    origin[2] + scale * offset[2], 1.0 };
  double clip[4];
  this->SceneToClip->MultiplyPoint(place, clip);
  return std::clamp(0.5 + 0.5 * clip[2] / clip[3], 0.0, 1.0);
}
