// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointSplatMemory_h
#define vtkIsopointSplatMemory_h

#include "vtkType.h"

#include <cstddef>

class vtkUnsignedCharArray;

/// Where VTK's arrays find no memory they end the program, unless VTK was built without assertions.
/// These throw instead.
namespace vtkIsopointSplatMemory
{

/// Gives an array so many tuples, of any values.
/// @throws std::bad_alloc
void Allocate(vtkUnsignedCharArray* array, vtkIdType tuples);

/// Does nothing where so many bytes can be allocated in one piece. To be called immediately before
/// methods of VTK that allocate arrays of a known size by themselves.
/// @throws std::bad_alloc
void Require(std::size_t bytes);

} // namespace vtkIsopointSplatMemory

#endif
// VTK-HeaderTest-Exclude: vtkIsopointSplatMemory.h
