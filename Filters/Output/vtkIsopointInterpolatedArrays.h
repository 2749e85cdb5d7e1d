// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInterpolatedArrays_h
#define vtkIsopointInterpolatedArrays_h

#include "Core/ExtractionRequest.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;

/// Interpolates the input's arrays at the isopoints of all surfaces, one surface after the other,
/// and adds them to the output's point data. Integers are rounded to the nearest; pedigree ids and
/// strings are copied from the nearer end. Active attributes remain active. Global ids, ghost
/// arrays, arrays not as long as the contoured array, and the contoured array are dropped.
/// @throws std::bad_alloc
void vtkInterpolateIsopointArrays(const isopoint::Execution& execution, vtkDataSetAttributes* input,
  vtkDataArray* contoured, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPointData* output);

/// Adds the contoured array, filled with isovalues, as active scalars: float as the input's, else
/// double.
/// @throws std::bad_alloc
void vtkAddContouredArray(vtkDataArray* contoured,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPointData* output);

#endif
