// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOutputArrays_h
#define vtkIsopointOutputArrays_h

#include "Core/ExtractionRequest.h"

#include "vtkType.h"

#include <string>
#include <vector>

namespace isopoint
{
struct Execution;
struct Options;
} // namespace isopoint
class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;
class vtkPolyData;

// Functions that add arrays do so for the isopoints of all surfaces, one surface after the other,
// and throw std::bad_alloc.

/// Interpolates the input's arrays. Integers are rounded to the nearest; ids and strings are copied
/// from the nearer end. Active attributes remain active. Global ids, ghost arrays,
/// arrays not as long as the contoured array, and the contoured array are dropped.
void vtkInterpolateIsopointArrays(const isopoint::Execution& execution, vtkDataSetAttributes* input,
  vtkDataArray* contoured, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPointData* output);

/// Sets a number of an array, in the array's type as isopoint::toArrayType() converts it.
void vtkSetIsopointNumber(vtkDataArray* array, vtkIdType tuple, int component, double number);

/// Adds the contoured array, filled with isovalues, as active scalars: float as the input's, else
/// double.
void vtkAddContouredArray(vtkDataArray* contoured,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPointData* output);

/// Adds the computed arrays that the options request: normals, splats, gradients and orders of
/// fits. Normals become active. Splat shapes become cell data of the vertices, hidden from menus,
/// with the axes as active vectors.
/// @returns the names of the arrays that replaced another array
std::vector<std::string> vtkAddComputedIsopointArrays(const isopoint::Execution& execution,
  const isopoint::Options& options, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPolyData* output);

#endif
