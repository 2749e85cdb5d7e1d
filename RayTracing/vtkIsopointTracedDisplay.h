// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointTracedDisplay_h
#define vtkIsopointTracedDisplay_h

#include "vtkNew.h"

#include <memory>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

/// Draws a picture with depths over the viewport.
class vtkIsopointTracedDisplay
{
public:
  vtkIsopointTracedDisplay();
  ~vtkIsopointTracedDisplay();
  vtkIsopointTracedDisplay(const vtkIsopointTracedDisplay&) = delete;
  vtkIsopointTracedDisplay& operator=(const vtkIsopointTracedDisplay&) = delete;

  /// @param colors four numbers per pixel, rows from the bottom: color times coverage, and coverage
  /// @param depths as in OpenGL; 1 where nothing is drawn
  void Draw(vtkOpenGLRenderWindow* window, int width, int height, const std::vector<float>& colors,
    const std::vector<float>& depths);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkTextureObject> Depths;
};

#endif
