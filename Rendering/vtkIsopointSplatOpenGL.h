// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatOpenGL_h
#define vtkIsopointSplatOpenGL_h

// VTK changed its loader of OpenGL's functions with version 9.4.
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatOpenGL.h
