// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedSurfaces_h
#define vtkIsopointTracedSurfaces_h

#include "Tracer/Surface.h"
#include "vtkIsopointTracedFrame.h"

#include <array>
#include <memory>
#include <vector>

class vtkActor;
class vtkMapper;
class vtkPolyData;

/// A polydata with points, and its display attributes in a composite.
struct vtkIsopointTracedBlock
{
  vtkPolyData* Data = nullptr;
  bool Visible = true;
  bool HasColor = false; // replaces scalar colors and the material's color
  std::array<double, 3> Color = { 0.0, 0.0, 0.0 };
};

/// The input of a mapper, or the leaves of its composite input. A leaf has the visibility and color
/// of the innermost block around it that has any.
std::vector<vtkIsopointTracedBlock> vtkGetTracedBlocks(vtkMapper* mapper);

/// The visible triangles of an actor, one surface per block.
/// @param absorptionDistance in world units; 0: the actor's diagonal
std::vector<std::shared_ptr<raytracing::Surface>> vtkMakeTracedSurfaces(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame);

#endif
