// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedScene.h"

#include "vtkIsopointSplatBlocks.h"
#include "vtkIsopointSplatMapper.h"
#include "vtkIsopointTracedCompatibility.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"

#include <cmath>
#include <sstream>

namespace
{

std::vector<vtkIsopointSplatLeaf> leavesOf(vtkMapper* mapper)
{
  const auto splats = vtkIsopointSplatMapper::SafeDownCast(mapper);
  return vtkIsopointSplatLeaves(
    mapper->GetInputDataObject(0, 0), splats ? splats->GetCompositeDataDisplayAttributes()
                                             : vtkIsopointTracedBlockAttributes(mapper));
}

/// Differs after each change of an actor that changes its traced surfaces.
void describe(vtkActor* actor, std::ostream& state)
{
  vtkMapper* const mapper = actor->GetMapper();
  mapper->GetLookupTable(); // the first call makes one, which modifies the mapper
  state << actor << ' ' << mapper << ' ' << mapper->GetMTime() << ' '
        << actor->GetProperty()->GetMTime() << std::hexfloat;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      state << ' ' << actor->GetMatrix()->GetElement(row, column);
    }
  }
  for (const vtkIsopointSplatLeaf& leaf : leavesOf(mapper))
  {
    state << '\n'
          << leaf.Data << ' ' << leaf.Data->GetMTime() << ' ' << leaf.Visible << leaf.HasColor
          << leaf.Color[0] << ' ' << leaf.Color[1] << ' ' << leaf.Color[2];
  }
  state << '\n';
}

vtkIsopointTracedFrame frameOf(const std::vector<vtkActor*>& actors)
{
  vtkBoundingBox box;
  for (vtkActor* const actor : actors)
  {
    if (const double* const bounds = actor->GetBounds())
    {
      const vtkBoundingBox its(bounds);
      if (its.IsValid() && std::isfinite(its.GetDiagonalLength()))
      {
        box.AddBox(its);
      }
    }
  }
  vtkIsopointTracedFrame frame;
  if (box.IsValid())
  {
    box.GetCenter(frame.Center.data());
    const double length = box.GetDiagonalLength();
    frame.Length = length > 0.0 && std::isfinite(length) ? length : 1.0;
  }
  return frame;
}

} // namespace

//------------------------------------------------------------------------------
bool vtkIsopointIsTraced(vtkProp* prop)
{
  const auto actor = vtkActor::SafeDownCast(prop);
  if (!actor || !actor->GetVisibility() || !actor->GetMapper())
  {
    return false;
  }
  vtkMapper* const mapper = actor->GetMapper();
  const bool isPolyData = vtkPolyDataMapper::SafeDownCast(mapper) ||
                          vtkIsopointTracedCompositeMapper::SafeDownCast(mapper);
  if (!isPolyData)
  {
    return false;
  }
  if (mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->GetInputAlgorithm()->Update();
  }
  if (vtkIsopointSplatMapper::SafeDownCast(mapper))
  {
    return true;
  }
  if (actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    return false;
  }
  const std::vector<vtkIsopointSplatLeaf> leaves = leavesOf(mapper);
  return std::any_of(leaves.begin(), leaves.end(),
    [](const vtkIsopointSplatLeaf& leaf)
    { return leaf.Data->GetNumberOfPolys() + leaf.Data->GetNumberOfStrips() > 0; });
}

//------------------------------------------------------------------------------
bool vtkIsopointTracedScene::Update(
  const std::vector<vtkActor*>& actors, double absorptionDistance, const double* cameraPosition)
{
  std::ostringstream state;
  state << std::hexfloat << absorptionDistance << '\n';
  bool facesCamera = false;
  for (vtkActor* const actor : actors)
  {
    describe(actor, state);
    for (const vtkIsopointSplatLeaf& leaf : leavesOf(actor->GetMapper()))
    {
      facesCamera = facesCamera || !leaf.Data->GetPointData()->GetNormals();
    }
  }
  if (facesCamera)
  {
    state << cameraPosition[0] << ' ' << cameraPosition[1] << ' ' << cameraPosition[2];
  }
  if (this->Scene && state.str() == this->State)
  {
    return false;
  }
  this->Clear();
  this->Frame = frameOf(actors);
  vtkIsopointTracedSettings settings;
  settings.AbsorptionDistance = absorptionDistance;
  settings.CameraPosition = this->Frame.ToScene(cameraPosition);
  std::vector<std::shared_ptr<const raytracing::Splats>> splats;
  std::vector<std::shared_ptr<const raytracing::Triangles>> triangles;
  for (vtkActor* const actor : actors)
  {
    if (const auto mapper = vtkIsopointSplatMapper::SafeDownCast(actor->GetMapper()))
    {
      if (auto surface = vtkIsopointTracedSplats(actor, mapper, settings, this->Frame))
      {
        splats.push_back(std::move(surface));
      }
      continue;
    }
    for (auto& surface : vtkIsopointTracedTriangles(actor, settings, this->Frame))
    {
      triangles.push_back(std::move(surface));
    }
  }
  this->Scene = std::make_unique<raytracing::Scene>(std::move(splats), std::move(triangles));
  this->State = state.str();
  return true;
}

//------------------------------------------------------------------------------
void vtkIsopointTracedScene::Clear()
{
  this->Scene.reset();
  this->State.clear();
}
