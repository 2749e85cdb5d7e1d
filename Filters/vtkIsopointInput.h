// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInput_h
#define vtkIsopointInput_h

#include "vtkType.h"

#include <vector>

namespace isopoint
{
struct Execution;
class IsosurfaceExtractor;
} // namespace isopoint
class vtkDataSet;
struct vtkIsopointBlock;

/**
 * Hands the samples of blocks to an extractor, without converting or copying arrays: ids count
 * through one block after the other. Where the extractor holds the same positions already it gets
 * new values only. Throws what IsosurfaceExtractor::load() throws.
 */
void vtkLoadIsopointInput(const isopoint::Execution& execution,
  const std::vector<vtkIsopointBlock>& blocks, isopoint::IsosurfaceExtractor& extractor);

/**
 * Whether the points of a data set are stored as float.
 */
bool vtkHasFloatPositions(vtkDataSet* input);

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
