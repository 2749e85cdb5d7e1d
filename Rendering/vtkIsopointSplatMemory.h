// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatMemory_h
#define vtkIsopointSplatMemory_h

#include "vtkType.h"

#include <cstddef>

class vtkUnsignedCharArray;

/// Allocation that throws. VTK's arrays end the program where there is no memory for them, unless
/// VTK was built without assertions.
namespace vtkIsopointSplatMemory
{

/// Sets the number of tuples of an array, whose values are then undefined.
/// @throws std::bad_alloc
void Allocate(vtkUnsignedCharArray* array, vtkIdType tuples);

/// Checks that a number of bytes can be allocated in one piece, immediately before a method of VTK
/// that allocates arrays of that size. Other threads may take the memory in between.
/// @throws std::bad_alloc
void Require(std::size_t bytes);

} // namespace vtkIsopointSplatMemory

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatMemory.h
