// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInputState_h
#define vtkIsopointInputState_h

#include "vtkType.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkDataArray;
class vtkDataObject;

/**
 * The key of what was computed from an input, such as a kept tree: equal states mean the same input
 * objects, unchanged. It lists the modification times of these objects in a fixed order: each time
 * is unique among all objects, whereas a maximum over several of them is not. Where VTK changes an
 * object without a new modification time, numbers that describe its content follow (counts, or a
 * hash).
 */
using vtkIsopointInputState = std::vector<vtkMTimeType>;

/**
 * The state of everything that determines the positions of a leaf's points and cells, and which of
 * them are ghosts, hidden or masked. O(values of ghost arrays and mask + hyper trees), on the
 * threads of the execution.
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkIsopointInputState vtkGetIsopointGeometryState(
  const isopoint::Execution& execution, vtkDataObject* leaf);

/**
 * Appends the state of an array of values.
 */
void vtkAppendIsopointArrayState(vtkIsopointInputState& state, vtkDataArray* array);

#endif
