// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointGhosts_h
#define vtkIsopointGhosts_h

#include "vtkSmartPointer.h"

class vtkDataSet;
class vtkDataSetAttributes;
class vtkUnsignedCharArray;

/**
 * The ghost array of points or cells as VTK keeps it, or null if there is none of the right type
 * and at least that many values.
 */
vtkUnsignedCharArray* vtkGetIsopointGhosts(vtkDataSetAttributes* attributes, vtkIdType count);

/**
 * Which points of a data set are no samples, as vtkIsopointBlock::Ghosts: ghost and hidden ones,
 * and those that belong to cells of which every one is hidden or covered by a finer level or, where
 * the points have no ghost array, is a ghost. Points that belong to no cell are samples. Null if
 * all points are.
 */
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostPoints(vtkDataSet* input);

/**
 * Which cells of a data set are no samples: ghost cells, hidden ones, those covered by a finer
 * level, and those with a hidden point. Null if there are none.
 */
vtkSmartPointer<vtkUnsignedCharArray> vtkFindGhostCells(vtkDataSet* input);

#endif
