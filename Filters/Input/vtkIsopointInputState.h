// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointInputState_h
#define vtkIsopointInputState_h

#include "vtkType.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkDataObject;

/// A key for data computed from an input: equal states mean the same, unchanged input objects.
/// Lists their modification times in a fixed order; unlike the maximum, each is unique among all
/// objects. Where VTK changes an object without a new time, counts or a hash of its contents
/// follow.
using vtkIsopointInputState = std::vector<vtkMTimeType>;

/// The state of everything that determines the positions of a leaf's points and cells, and which of
/// them are ghosts, hidden or masked. O(ghost values + mask + hyper trees), in parallel.
/// @throws std::bad_alloc, isopoint::Aborted
vtkIsopointInputState vtkGetIsopointGeometryState(
  const isopoint::Execution& execution, vtkDataObject* leaf);

#endif
