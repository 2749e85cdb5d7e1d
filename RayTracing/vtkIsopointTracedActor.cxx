// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedActor.h"

#include "vtkIsopointTracedBlocks.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

//------------------------------------------------------------------------------
raytracing::Material vtkIsopointTracedMaterial(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame)
{
  vtkProperty* const property = actor->GetProperty();
  raytracing::Material material;
  material.isPhysical = property->GetInterpolation() == VTK_PBR;
  material.opacity = static_cast<float>(property->GetOpacity());
  const bool isLit = property->GetLighting();
  material.ambient = isLit ? static_cast<float>(property->GetAmbient()) : 1.0f;
  material.diffuse = isLit ? static_cast<float>(property->GetDiffuse()) : 0.0f;
  material.specular = isLit ? static_cast<float>(property->GetSpecular()) : 0.0f;
  material.specularPower = static_cast<float>(property->GetSpecularPower());
  material.specularColor = vtkIsopointTracedVector(property->GetSpecularColor());
  material.metallic = static_cast<float>(property->GetMetallic());
  material.roughness = static_cast<float>(property->GetRoughness());
  material.refractiveIndex = static_cast<float>(property->GetBaseIOR());
  const double distance = absorptionDistance > 0.0 ? absorptionDistance : actor->GetLength();
  constexpr double least = 1e-6;
  material.absorptionDistance = static_cast<float>(std::max(distance / frame.Length, least));
  return material;
}

//------------------------------------------------------------------------------
raytracing::Color vtkIsopointTracedColor(vtkActor* actor, const vtkIsopointTracedBlock& block)
{
  return vtkIsopointTracedVector(
    block.HasColor ? block.Color.data() : actor->GetProperty()->GetDiffuseColor());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnsignedCharArray> vtkIsopointTracedColors(
  vtkMapper* mapper, vtkPolyData* data, int& cellFlag)
{
  // Another mapper with the same settings, since mapping keeps its result in the mapper.
  vtkNew<vtkOpenGLPolyDataMapper> colors;
  colors->vtkMapper::ShallowCopy(mapper);
  colors->SetInterpolateScalarsBeforeMapping(false);
  return colors->MapScalars(data, 1.0, cellFlag);
}
