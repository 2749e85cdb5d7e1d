// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointComputedArrays_h
#define vtkIsopointComputedArrays_h

#include "Core/ExtractionRequest.h"

#include <string>
#include <vector>

namespace isopoint
{
struct Execution;
struct Options;
} // namespace isopoint
class vtkPolyData;

/// Adds the computed arrays that the options request: normals, splats, gradients and orders of
/// fits, for the isopoints of all surfaces, one surface after the other. Normals become active.
/// Splat shapes become cell data of the vertices, hidden from menus, with the axes as active
/// vectors.
/// @returns the names of the arrays that replaced another array
/// @throws std::bad_alloc
std::vector<std::string> vtkAddComputedIsopointArrays(const isopoint::Execution& execution,
  const isopoint::Options& options, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPolyData* output);

#endif
