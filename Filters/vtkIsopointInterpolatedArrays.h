// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInterpolatedArrays_h
#define vtkIsopointInterpolatedArrays_h

#include "Isopoint/IsosurfaceExtractor.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkDataArray;
class vtkDataSetAttributes;
class vtkPointData;

/**
 * Fills the output's point data with the input's arrays at the isopoints of all surfaces, one
 * surface after the other: numbers interpolated (integers rounded to the nearest), pedigree ids
 * and strings taken from the nearer end, active attributes kept. Global ids, ghost arrays, arrays
 * that are not as long as the contoured one and the contoured array itself are left out.
 */
void vtkInterpolateIsopointArrays(const isopoint::Execution& execution, vtkDataSetAttributes* input,
  vtkDataArray* contoured, const std::vector<isopoint::ExtractedIsosurface>& surfaces,
  vtkPointData* output);

/**
 * Adds the contoured array, each value exactly the isovalue: of the input's type where that is
 * float or double, of type double otherwise. It becomes the active scalars.
 */
void vtkAddContouredArray(vtkDataArray* contoured,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPointData* output);

#endif
