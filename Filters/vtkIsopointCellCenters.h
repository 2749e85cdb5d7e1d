// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointCellCenters_h
#define vtkIsopointCellCenters_h

#include "vtkSmartPointer.h"

namespace isopoint
{
struct Execution;
}
class vtkDataSet;
class vtkHyperTreeGrid;
class vtkPoints;
struct vtkIsopointBlock;

/**
 * A grid of one point for each cell, the cell's centre, where that takes next to no memory: of an
 * image or a rectilinear grid. Null for other data sets.
 */
vtkSmartPointer<vtkDataSet> vtkMakeDualGrid(vtkDataSet* input);

/**
 * The centres of all cells, as vtkCellCenters defines them; not a number for empty cells. Of the
 * type of the data set's points. O(cells), on the execution's threads.
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkSmartPointer<vtkPoints> vtkComputeCellCenters(
  const isopoint::Execution& execution, vtkDataSet* input);

/**
 * Sets a block's positions and ghosts to the leaves of a hyper tree grid: ids are those of its cell
 * data, which also has coarse nodes (vtkIsopointBlock::Fillers). Masked leaves and ghosts are left
 * out.
 */
void vtkFindLeafCenters(vtkHyperTreeGrid* input, vtkIdType count, vtkIsopointBlock& block);

#endif
