// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInput_h
#define vtkIsopointInput_h

#include "vtkType.h"

namespace isopoint
{
struct Execution;
class IsosurfaceExtractor;
} // namespace isopoint
class vtkDataArray;
class vtkDataSet;

/**
 * Hands the points of a data set and their scalars to an extractor, without converting arrays.
 * Where the extractor holds the same positions already it gets new values only. Throws what
 * IsosurfaceExtractor::load() throws.
 */
void vtkLoadIsopointInput(const isopoint::Execution& execution, vtkDataSet* input,
  vtkDataArray* scalars, isopoint::IsosurfaceExtractor& extractor);

/**
 * Writes the position of a point of the data set; thread-safe.
 */
class vtkIsopointPositions
{
public:
  explicit vtkIsopointPositions(vtkDataSet* input);

  void Get(vtkIdType point, double position[3]) const;

private:
  vtkDataSet* Input;
  const float* Floats = nullptr;
  const double* Doubles = nullptr;
};

#endif
