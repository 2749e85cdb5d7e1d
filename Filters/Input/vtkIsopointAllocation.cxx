// SPDX-License-Identifier: GPL-3.0-or-later
#include "Input/vtkIsopointAllocation.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"

#include <cstddef>
#include <cstdlib>
#include <new>

void vtkAllocateTuples(vtkAbstractArray* array, vtkIdType tuples)
{
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  const bool isContiguous =
    numbers && numbers->HasStandardMemoryLayout() && numbers->GetDataType() != VTK_BIT;
  if (!isContiguous || tuples == 0)
  {
    array->SetNumberOfTuples(tuples);
    return;
  }
  const vtkIdType values = tuples * numbers->GetNumberOfComponents();
  void* const memory = std::malloc(
    static_cast<std::size_t>(values) * static_cast<std::size_t>(numbers->GetDataTypeSize()));
  if (!memory)
  {
    throw std::bad_alloc();
  }
  numbers->SetVoidArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
}
