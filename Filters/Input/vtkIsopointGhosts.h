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

/**
 * The ghost array of points or cells, or null if there is none with one component and at least
 * `count` values.
 */
vtkUnsignedCharArray* vtkGetIsopointGhosts(vtkDataSetAttributes* attributes, vtkIdType count);

/**
 * The points of a data set that take no part, as vtkIsopointBlock::Ghosts: ghost and hidden points,
 * and points all of whose cells are hidden, covered by a finer level or, if the points have no
 * ghost array, ghosts. Points without cells take part. Null only if all points do.
 * @param wholeExtent of the structured grid of which the data set is a piece of one of several
 * ranks, or null: the last points along each axis, which the next piece has as well, are left out
 * @returns the input's own array, or a new one
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostPoints(
  const isopoint::Execution& execution, vtkDataSet* input, const int* wholeExtent);

/**
 * The cells of a data set that take no part, as vtkIsopointBlock::Ghosts: ghost and hidden cells,
 * those covered by a finer level, and those with a hidden point. Null if all cells take part.
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostCells(
  const isopoint::Execution& execution, vtkDataSet* input);

#endif
