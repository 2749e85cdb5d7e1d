// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedSurfaces_h
#define vtkIsopointTracedSurfaces_h

#include "Tracer/Surface.h"
#include "vtkIsopointTracedFrame.h"

#include <memory>
#include <vector>

class vtkActor;

/// The visible triangles of an actor, one surface per block.
/// @param absorptionDistance in world units; 0: the actor's diagonal
std::vector<std::shared_ptr<raytracing::Surface>> vtkIsopointTracedSurfaces(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame);

#endif
