// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointCellCenters_h
#define vtkIsopointCellCenters_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

namespace isopoint
{
struct Execution;
}
class vtkDataSet;
class vtkHyperTreeGrid;
class vtkPoints;
struct vtkIsopointBlock;

/**
 * The dual grid of an image or a rectilinear grid, whose points are the centers of the cells; it
 * takes next to no memory. Null for other data sets.
 */
vtkSmartPointer<vtkDataSet> vtkMakeDualGrid(vtkDataSet* input);

/**
 * The centers of all cells as vtkCellCenters defines them, NaN for empty cells. They are float if
 * the points of the data set are, else double. O(cells), on the threads of the execution.
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkSmartPointer<vtkPoints> vtkComputeCellCenters(
  const isopoint::Execution& execution, vtkDataSet* input);

/**
 * Sets the positions and ghosts of a block to the leaves of a hyper tree grid. Sample ids are those
 * of its cell data, `count` in number; masked leaves, ghosts and ids that stand for no leaf take no
 * part (see vtkIsopointBlock::NumberOfUnusedIds).
 * @throws std::bad_alloc
 */
void vtkFindLeafCenters(vtkHyperTreeGrid* input, vtkIdType count, vtkIsopointBlock& block);

#endif
