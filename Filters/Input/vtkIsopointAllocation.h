// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointAllocation_h
#define vtkIsopointAllocation_h

#include "vtkType.h"

class vtkAbstractArray;

/// Sets the number of tuples of an array; their values are undefined. Unlike
/// vtkAbstractArray::SetNumberOfTuples(), which may end the program, it reports a lack of memory,
/// except for bit arrays and arrays that are not contiguous in memory.
/// @throws std::bad_alloc
void vtkAllocateTuples(vtkAbstractArray* array, vtkIdType tuples);

#endif
