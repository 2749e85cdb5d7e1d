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

/**
 * Adds the input's arrays at the isopoints of all surfaces, one surface after the other, to the
 * point data of the output. Numeric arrays are interpolated, integers rounded to the nearest;
 * pedigree ids and strings are copied from the nearer end. Active attributes remain active. Global
 * ids, ghost arrays, arrays not as long as the contoured one, and the contoured array itself are
 * dropped.
 * @throws std::bad_alloc
 */
void vtkInterpolateIsopointArrays(const isopoint::Execution& execution, vtkDataSetAttributes* input,
  vtkDataArray* contoured, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPointData* output);

/**
 * Adds the contoured array, whose values are exactly the isovalues, as the active scalars: of type
 * float if the input's is, else double.
 * @throws std::bad_alloc
 */
void vtkAddContouredArray(vtkDataArray* contoured,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPointData* output);

#endif
