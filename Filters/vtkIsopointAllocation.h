// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointAllocation_h
#define vtkIsopointAllocation_h

#include "vtkType.h"

class vtkAbstractArray;

/**
 * Gives an array so many tuples, of any values. Arrays would do so themselves, but VTK ends the
 * program where there is no memory for it, unless it was built without assertions.
 * @throws std::bad_alloc
 */
void vtkAllocateTuples(vtkAbstractArray* array, vtkIdType tuples);

#endif
