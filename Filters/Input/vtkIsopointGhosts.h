// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointGhosts_h
#define vtkIsopointGhosts_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

namespace isopoint
{
struct Execution;
}
class vtkDataSet;
class vtkDataSetAttributes;
class vtkUnsignedCharArray;

/// The ghost array, or null unless it has one component and at least `count` values.
vtkUnsignedCharArray* vtkGetIsopointGhosts(vtkDataSetAttributes* attributes, vtkIdType count);

/// Marks the points of a data set to be skipped, as vtkIsopointBlock::Ghosts: ghost and hidden
/// points, and points whose cells are all hidden, covered by a finer level or, without a ghost
/// array of the points, ghosts. Points without cells are not skipped. Null if none are skipped.
/// @param wholeExtent of the structured grid whose pieces are distributed over ranks, or null;
/// skips the last points along each axis if the next piece has them too
/// @returns the input's own array, or a new one
/// @throws std::bad_alloc, isopoint::Aborted
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostPoints(
  const isopoint::Execution& execution, vtkDataSet* input, const int* wholeExtent);

/// Marks the cells of a data set to be skipped, as vtkIsopointBlock::Ghosts: ghost and hidden
/// cells, cells covered by a finer level, and cells with a hidden point. Null if none are skipped.
/// @throws std::bad_alloc, isopoint::Aborted
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostCells(
  const isopoint::Execution& execution, vtkDataSet* input);

/// Hides points of a data set, and cells with any of them, in its ghost arrays.
/// @param hidden by point; not 0: to hide
/// @throws std::bad_alloc, isopoint::Aborted
void vtkHideIsopointPoints(
  const isopoint::Execution& execution, const unsigned char* hidden, vtkDataSet* data);

#endif
