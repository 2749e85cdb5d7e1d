// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointAllocation_h
#define vtkIsopointAllocation_h

#include "vtkType.h"

class vtkAbstractArray;

/**
 * Sets the number of tuples of an array; their values are undefined. Unlike
 * vtkAbstractArray::SetNumberOfTuples(), it reports a lack of memory: VTK ends the program then,
 * unless it was built without assertions. (For arrays that are not contiguous in memory, and bit
 * arrays, VTK allocates all the same.)
 * @throws std::bad_alloc
 */
void vtkAllocateTuples(vtkAbstractArray* array, vtkIdType tuples);

#endif
