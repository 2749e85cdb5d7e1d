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

/// The dual grid of an image or rectilinear grid, with cell centers as points and almost no memory;
/// null for other data sets.
vtkSmartPointer<vtkDataSet> vtkMakeDualGrid(vtkDataSet* input);

/// The centers of all cells as defined by vtkCellCenters, NaN for empty cells. Float if the points
/// of the data set are, otherwise double. O(cells), in parallel.
/// @throws isopoint::UsageError if there are cells, but no points; std::bad_alloc,
/// isopoint::Aborted
vtkSmartPointer<vtkPoints> vtkComputeCellCenters(
  const isopoint::Execution& execution, vtkDataSet* input);

/// The leaves of a hyper tree grid as samples.
struct vtkIsopointLeafCenters
{
  vtkSmartPointer<vtkPoints> Points;
  vtkSmartPointer<vtkUnsignedCharArray> Ghosts; // as vtkIsopointBlock::Ghosts
  vtkIdType NumberOfUnusedIds;                  // as vtkIsopointBlock::NumberOfUnusedIds
};

/// Sample ids are those of the `count` values of the grid's cell data. Masked leaves, ghosts and
/// ids without a leaf are marked in `Ghosts`, and their points are NaN.
/// @throws std::bad_alloc, isopoint::Aborted
vtkIsopointLeafCenters vtkFindLeafCenters(
  const isopoint::Execution& execution, vtkHyperTreeGrid* input, vtkIdType count);

#endif
