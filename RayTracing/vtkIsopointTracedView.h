// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedView_h
#define vtkIsopointTracedView_h

#include "Tracer/Picture.h"
#include "vtkIsopointTracedFrame.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"

class vtkRenderer;

/// A renderer's camera, lights and environment, in the scene's coordinates.
struct vtkIsopointTracedView
{
  /// @param aspect width over height of the picture
  /// @param lightAngle apparent angle of lights, in degrees
  vtkIsopointTracedView(
    vtkRenderer* renderer, double aspect, double lightAngle, const vtkIsopointTracedFrame& frame);

  /// The depth of a position as in OpenGL, 0 on the near plane and 1 on the far plane.
  /// @param x, y window coordinates, 0 to 1
  /// @param distance from the near plane along the ray through x, y
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
