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

/**
 * Adds the arrays that are computed for isopoints, as the options ask for them: normals, splats,
 * gradients and orders of fits. They hold the isopoints of all surfaces, one surface after the
 * other. Normals become the active ones. The arrays of the shapes of splats become cell data of the
 * vertices, hidden from menus, the axes as the active vectors.
 * @returns the names of the arrays that replaced another one
 * @throws std::bad_alloc
 */
std::vector<std::string> vtkAddComputedIsopointArrays(const isopoint::Execution& execution,
  const isopoint::Options& options, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPolyData* output);

#endif
