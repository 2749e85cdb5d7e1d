// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointArrays_h
#define vtkIsopointArrays_h

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

/// Sets the number of tuples of an array; their values are undefined. Unlike
/// vtkAbstractArray::SetNumberOfTuples(), which may end the program, it reports a lack of memory,
/// except for bit arrays and arrays that are not contiguous in memory.
/// @throws std::bad_alloc
inline void vtkAllocateTuples(vtkAbstractArray* array, vtkIdType tuples)
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

/// An array with the type, names and components of another one; its values are undefined.
/// @throws std::bad_alloc
inline vtkSmartPointer<vtkAbstractArray> vtkNewArrayLike(vtkAbstractArray* array, vtkIdType tuples)
{
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->CopyComponentNames(array);
  vtkAllocateTuples(copy, tuples);
  return copy;
}

/// Adds an array, as the active attribute of this type unless it is -1.
inline void vtkAddAttribute(int type, vtkAbstractArray* array, vtkDataSetAttributes* attributes)
{
  const int index = attributes->AddArray(array);
  if (type >= 0)
  {
    attributes->SetActiveAttribute(index, type);
  }
}

/// Whether an array of this name, which may be null, has ghost marks.
inline bool vtkIsGhostArrayName(const char* name)
{
  return name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0;
}

/// Whether an array has ids: global, pedigree and process ids, and arrays of type vtkIdType.
/// @param attribute a vtkDataSetAttributes::AttributeTypes, or -1
inline bool vtkHasIsopointIds(vtkAbstractArray* array, int attribute)
{
  constexpr int processIds = 11; // vtkDataSetAttributes::PROCESSIDS, since VTK 9.3
  return attribute == vtkDataSetAttributes::GLOBALIDS ||
         attribute == vtkDataSetAttributes::PEDIGREEIDS || attribute == processIds ||
         array->GetDataType() == VTK_ID_TYPE;
}

/// Whether an array holds numbers of type float or double.
inline bool vtkIsReal(vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

// Arrays of splats, and of ids of what polygons of splats come from.
constexpr const char* vtkRadiusArrayName = "Radius";
constexpr const char* vtkSplatAxisArrayName = "SplatAxis";
constexpr const char* vtkSplatPolygonArrayName = "SplatPolygon";
constexpr const char* vtkOriginalPointIdsArrayName = "vtkOriginalPointIds";
constexpr const char* vtkOriginalCellIdsArrayName = "vtkOriginalCellIds";

/// The type of the coordinates of points; double if no array has them.
inline int vtkGetTypeOfPoints(vtkDataSet* data)
{
  auto* const points = vtkPointSet::SafeDownCast(data);
  return points && points->GetPoints() ? points->GetPoints()->GetDataType() : VTK_DOUBLE;
}

#endif
