// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedActor_h
#define vtkIsopointTracedActor_h

#include "Tracer/Surface.h"
#include "vtkIsopointTracedPlacement.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkActor;
class vtkMapper;
class vtkPolyData;
class vtkUnsignedCharArray;
struct vtkIsopointTracedBlock;

/// The material that a property stands for, see vtkIsopointRayTracer.
/// @param absorptionDistance of the world; 0: the actor's diagonal
raytracing::Material vtkIsopointTracedMaterial(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame);

/// The color of a polydata without scalar colors.
raytracing::Color vtkIsopointTracedColor(vtkActor* actor, const vtkIsopointTracedBlock& block);

/// The colors that a mapper gives to a polydata's scalars, and whether they are those of points
/// (0), of cells (1) or of the field (2); null where it gives none. The mapper is left as it is.
vtkSmartPointer<vtkUnsignedCharArray> vtkIsopointTracedColors(
  vtkMapper* mapper, vtkPolyData* data, int& cellFlag);

/// The visible triangles of an actor, a surface for each block.
/// @param absorptionDistance of the world; 0: the actor's diagonal
std::vector<std::shared_ptr<raytracing::Surface>> vtkIsopointTracedSurfaces(
  vtkActor* actor, double absorptionDistance, const vtkIsopointTracedFrame& frame);

#endif
// VTK-HeaderTest-Exclude: vtkIsopointTracedActor.h
