// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatOpenGL_h
#define vtkIsopointSplatOpenGL_h

// VTK 9.4 replaced its loader of OpenGL's functions.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include <new>

/// Reports that OpenGL has no memory, and clears OpenGL's own errors, which VTK would print at
/// every frame.
/// @throws std::bad_alloc
[[noreturn]] inline void vtkIsopointSplatOutOfGraphicsMemory()
{
  for (int i = 0; i < 100 && glGetError() != GL_NO_ERROR; ++i)
  {
  }
  throw std::bad_alloc();
}

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatOpenGL.h
