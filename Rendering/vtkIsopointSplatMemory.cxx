// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointSplatMemory.h"

#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <new>

//------------------------------------------------------------------------------
void vtkIsopointSplatMemory::Allocate(vtkUnsignedCharArray* array, vtkIdType tuples)
{
  const vtkIdType values = tuples * array->GetNumberOfComponents();
  void* const memory = std::malloc(static_cast<std::size_t>(values));
  if (!memory && values > 0)
  {
    throw std::bad_alloc();
  }
  array->SetArray(
    static_cast<unsigned char*>(memory), values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
}

//------------------------------------------------------------------------------
void vtkIsopointSplatMemory::Require(std::size_t bytes)
{
  // Volatile, since compilers may remove an allocation that is not used.
  void* volatile memory = std::malloc(bytes);
  if (!memory && bytes > 0)
  {
    throw std::bad_alloc();
  }
  std::free(memory);
}
