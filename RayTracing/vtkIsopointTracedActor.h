// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedActor_h
#define vtkIsopointTracedActor_h

#include "Tracer/Surfaces.h"
#include "vtkIsopointTracedPlacement.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkActor;
class vtkIsopointSplatMapper;
class vtkMapper;
class vtkPolyData;
class vtkRenderer;
class vtkUnsignedCharArray;
struct vtkIsopointSplatLeaf;

/// What all surfaces of an actor share.
struct vtkIsopointTracedSettings
{
  double AbsorptionDistance = 0.0; // of the world; 0: the actor's diagonal
  std::array<double, 3> CameraPosition = { 0.0, 0.0,
    0.0 }; // of the scene; of splats without normals
};

/// The material that a property stands for, see vtkIsopointRayTracer.
raytracing::Material vtkIsopointTracedMaterial(
  vtkActor* actor, const vtkIsopointTracedSettings& settings, const vtkIsopointTracedFrame& frame);

/// The color of a polydata without scalar colors.
raytracing::Color vtkIsopointTracedColor(vtkActor* actor, const vtkIsopointSplatLeaf& leaf);

/// The colors that a mapper gives to a polydata's scalars, and whether they are those of points
/// (0), of cells (1) or of the field (2); null where it gives none. The mapper is left as it is.
vtkSmartPointer<vtkUnsignedCharArray> vtkIsopointTracedColors(
  vtkMapper* mapper, vtkPolyData* data, int& cellFlag);

/// The visible splats of an actor, all its blocks as one surface; null where there are none.
std::shared_ptr<raytracing::Splats> vtkIsopointTracedSplats(vtkActor* actor,
  vtkIsopointSplatMapper* mapper, const vtkIsopointTracedSettings& settings,
  const vtkIsopointTracedFrame& frame);

/// The visible triangles of an actor, a surface for each block.
std::vector<std::shared_ptr<raytracing::Triangles>> vtkIsopointTracedTriangles(
  vtkActor* actor, const vtkIsopointTracedSettings& settings, const vtkIsopointTracedFrame& frame);

#endif
// VTK-HeaderTest-Exclude: vtkIsopointTracedActor.h
