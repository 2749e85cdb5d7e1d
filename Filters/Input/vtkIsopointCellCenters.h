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
class vtkUnsignedCharArray;

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
 * The leaves of a hyper tree grid as samples.
 */
struct vtkIsopointLeafCenters
{
  vtkSmartPointer<vtkPoints> Points;
  vtkSmartPointer<vtkUnsignedCharArray> Ghosts; // as vtkIsopointBlock::Ghosts
  vtkIdType NumberOfUnusedIds;                  // as vtkIsopointBlock::NumberOfUnusedIds
};

/**
 * Sample ids are those of the grid's cell data, `count` in number; masked leaves, ghosts and ids
 * without a leaf take no part.
 * @throws std::bad_alloc, isopoint::Aborted
 */
vtkIsopointLeafCenters vtkFindLeafCenters(
  const isopoint::Execution& execution, vtkHyperTreeGrid* input, vtkIdType count);

#endif
