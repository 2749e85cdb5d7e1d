// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointTracedScene.h"

#include "vtkIsopointCompositeMapper.h"
#include "vtkIsopointTracedBlocks.h"
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
#include <sstream>

namespace
{

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
  for (const vtkIsopointTracedBlock& block : vtkIsopointTracedBlocks(mapper))
  {
    state << '\n'
          << block.Data << ' ' << block.Data->GetMTime() << ' ' << block.Visible << block.HasColor
          << block.Color[0] << ' ' << block.Color[1] << ' ' << block.Color[2];
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
  const bool isPolyData =
    vtkPolyDataMapper::SafeDownCast(mapper) || vtkIsopointCompositeMapper::SafeDownCast(mapper);
  if (!isPolyData)
  {
    return false;
  }
  if (mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->GetInputAlgorithm()->Update();
  }
  if (actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    return false;
  }
  const std::vector<vtkIsopointTracedBlock> blocks = vtkIsopointTracedBlocks(mapper);
  return std::any_of(blocks.begin(), blocks.end(),
    [](const vtkIsopointTracedBlock& block)
    { return block.Data->GetNumberOfPolys() + block.Data->GetNumberOfStrips() > 0; });
}

//------------------------------------------------------------------------------
bool vtkIsopointTracedScene::Update(const std::vector<vtkActor*>& actors, double absorptionDistance)
{
  std::ostringstream state;
  state << std::hexfloat << absorptionDistance << '\n';
  for (vtkActor* const actor : actors)
  {
    describe(actor, state);
  }
  if (this->Scene && state.str() == this->State)
  {
    return false;
  }
  this->Clear();
  this->Frame = frameOf(actors);
  std::vector<std::shared_ptr<const raytracing::Surface>> surfaces;
  for (vtkActor* const actor : actors)
  {
    for (auto& surface : vtkIsopointTracedSurfaces(actor, absorptionDistance, this->Frame))
    {
      surfaces.push_back(std::move(surface));
    }
  }
  this->Scene = std::make_unique<raytracing::Scene>(std::move(surfaces));
  this->State = state.str();
  return true;
}

//------------------------------------------------------------------------------
void vtkIsopointTracedScene::Clear()
{
  this->Scene.reset();
  this->State.clear();
}
