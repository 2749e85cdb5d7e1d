// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedView_h
#define vtkIsopointTracedView_h

#include "Tracer/Picture.h"
#include "vtkIsopointTracedFrame.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"

class vtkRenderer;

/// What of a renderer is traced besides its actors, in the scene's coordinates.
struct vtkIsopointTracedView
{
  /// @param aspect width over height of the picture
  /// @param lightAngle the angle under which lights are seen, in degrees
  vtkIsopointTracedView(
    vtkRenderer* renderer, double aspect, double lightAngle, const vtkIsopointTracedFrame& frame);

  /// The depth, 0 on the near plane and 1 on the far plane, as OpenGL has it, of a place.
  /// @param x, y of the window, 0 to 1
  /// @param distance from the near plane along the ray through them
  double GetDepth(double x, double y, double distance) const;

  raytracing::Camera Camera;
  std::vector<raytracing::Light> Lights;
  raytracing::Environment Environment;

private:
  void SetCamera(vtkRenderer* renderer, double aspect, const vtkIsopointTracedFrame& frame);
  void SetLights(vtkRenderer* renderer, double lightAngle, const vtkIsopointTracedFrame& frame);
  void SetEnvironment(vtkRenderer* renderer, double aspect);

  vtkNew<vtkMatrix4x4> SceneToClip;
};

#endif
