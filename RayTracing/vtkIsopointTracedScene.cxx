// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedScene.h"

#include "vtkIsopointCompositeMapper.h"
#include "vtkIsopointTracedSurfaces.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <cmath>

namespace
{

/// Describes everything about an actor that affects its traced surfaces.
void describe(vtkActor* actor, vtkIsopointTracedState& state)
{
  vtkMapper* const mapper = actor->GetMapper();
  mapper->GetLookupTable(); // the first call creates one, which modifies the mapper
  state.Add(actor, mapper, mapper->GetMTime(), actor->GetProperty()->GetMTime());
  for (const auto& row : actor->GetMatrix()->Element)
  {
    state.Add(row[0], row[1], row[2], row[3]);
  }
  for (const vtkIsopointTracedBlock& block : vtkGetTracedBlocks(mapper))
  {
    state.Add(block.Data, block.Data->GetMTime(), block.Visible, block.HasColor, block.Color[0],
      block.Color[1], block.Color[2]);
  }
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

bool vtkIsTraced(vtkProp* prop)
{
  const auto actor = vtkActor::SafeDownCast(prop);
  vtkMapper* const mapper = actor && actor->GetVisibility() ? actor->GetMapper() : nullptr;
  if (!vtkPolyDataMapper::SafeDownCast(mapper) && !vtkIsopointCompositeMapper::SafeDownCast(mapper))
  {
    return false;
  }
  if (mapper->GetNumberOfInputConnections(0) > 0 && !mapper->GetStatic())
  {
    mapper->GetInputAlgorithm()->Update();
  }
  if (actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    return false;
  }
  const std::vector<vtkIsopointTracedBlock> blocks = vtkGetTracedBlocks(mapper);
  return std::any_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointTracedBlock& block)
    { return block.Data->GetNumberOfPolys() + block.Data->GetNumberOfStrips() > 0; });
}

bool vtkIsopointTracedScene::Update(const std::vector<vtkActor*>& actors, double absorptionDistance)
{
  vtkIsopointTracedState state;
  state.Add(absorptionDistance);
  for (vtkActor* const actor : actors)
  {
    describe(actor, state);
  }
  if (this->Scene && state.Get() == this->State)
  {
    return false;
  }
  this->Clear();
  this->Frame = frameOf(actors);
  std::vector<std::shared_ptr<const raytracing::Surface>> surfaces;
  for (vtkActor* const actor : actors)
  {
    for (auto& surface : vtkMakeTracedSurfaces(actor, absorptionDistance, this->Frame))
    {
      surfaces.push_back(std::move(surface));
    }
  }
  this->Scene = std::make_unique<raytracing::Scene>(std::move(surfaces));
  this->State = state.Get();
  return true;
}

void vtkIsopointTracedScene::Clear()
{
  this->Scene.reset();
  this->State.clear();
}
