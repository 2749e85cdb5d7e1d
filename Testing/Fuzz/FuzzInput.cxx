// SPDX-License-Identifier: GPL-3.0-or-later
#include "FuzzInput.h"

#include "ByteSource.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>

namespace
{

/// A number near the given one that an array of this type represents exactly.
double representable(double number, int type)
{
  if (type == VTK_DOUBLE)
  {
    return number;
  }
  if (type == VTK_FLOAT)
  {
    return std::abs(number) > static_cast<double>(std::numeric_limits<float>::max())
             ? std::copysign(std::numeric_limits<double>::infinity(), number)
             : static_cast<double>(static_cast<float>(number));
  }
  // An integer of any type, signed or not.
  return std::isfinite(number) ? std::fmod(std::floor(std::abs(number)), 120.0) : 7.0;
}

vtkSmartPointer<vtkDataArray> newArray(
  ByteSource& bytes, const char* name, vtkIdType tuples, int type)
{
  const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  array->SetNumberOfTuples(tuples);
  const int kind = bytes.below(4);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->SetComponent(i, 0, representable(bytes.number(kind), type));
  }
  return array;
}

int scalarType(ByteSource& bytes)
{
  const int types[8] = { VTK_DOUBLE, VTK_FLOAT, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_INT,
    VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG };
  return types[bytes.below(8)];
}

void addArrays(ByteSource& bytes, vtkDataSetAttributes* attributes, vtkIdType count)
{
  if (bytes.below(8) != 0)
  {
    attributes->AddArray(newArray(bytes, "f", count, scalarType(bytes)));
  }
  if (bytes.below(4) == 0)
  {
    attributes->AddArray(newArray(bytes, "other", count, scalarType(bytes)));
  }
  if (bytes.below(8) == 0)
  {
    attributes->AddArray(newArray(bytes, "short", count / 2, VTK_DOUBLE));
  }
  if (bytes.below(8) == 0)
  {
    vtkNew<vtkStringArray> names;
    names->SetName("names");
    names->SetNumberOfValues(count);
    attributes->AddArray(names);
  }
  if (bytes.below(3) == 0)
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      ghosts->SetValue(i, bytes.below(3) == 0 ? bytes.byte() : 0);
    }
    attributes->AddArray(ghosts);
  }
}

vtkSmartPointer<vtkPoints> newPoints(ByteSource& bytes, vtkIdType count)
{
  const int type = bytes.flag() ? VTK_FLOAT : VTK_DOUBLE;
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(count);
  const int kind = bytes.below(4);
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      points->GetData()->SetComponent(i, axis, representable(bytes.number(kind), type));
    }
  }
  return points;
}

vtkSmartPointer<vtkDataSet> newDataSet(ByteSource& bytes)
{
  vtkSmartPointer<vtkDataSet> result;
  switch (bytes.below(4))
  {
    case 0:
    {
      vtkNew<vtkPolyData> cloud;
      cloud->SetPoints(newPoints(bytes, bytes.below(40)));
      result = cloud;
      break;
    }
    case 1:
    {
      vtkNew<vtkImageData> image;
      const int x = bytes.below(4);
      const int y = bytes.below(4);
      const int z = bytes.below(4);
      image->SetDimensions(x, y, z);
      image->SetOrigin(bytes.below(4), bytes.below(4), bytes.below(4));
      image->SetSpacing(1.0 + bytes.below(2), 1.0, 0.5);
      result = image;
      break;
    }
    case 2:
    {
      vtkNew<vtkRectilinearGrid> grid;
      int dimensions[3];
      vtkNew<vtkDoubleArray> coordinates[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        dimensions[axis] = 1 + bytes.below(4);
        double coordinate = bytes.below(8);
        for (int i = 0; i < dimensions[axis]; ++i)
        {
          coordinates[axis]->InsertNextValue(coordinate);
          coordinate += 0.25 * bytes.below(16);
        }
      }
      grid->SetDimensions(dimensions);
      grid->SetXCoordinates(coordinates[0]);
      grid->SetYCoordinates(coordinates[1]);
      grid->SetZCoordinates(coordinates[2]);
      result = grid;
      break;
    }
    default:
    {
      vtkNew<vtkUnstructuredGrid> grid;
      const int count = 1 + bytes.below(30);
      grid->SetPoints(newPoints(bytes, count));
      const int cells = bytes.below(20);
      for (int cell = 0; cell < cells; ++cell)
      {
        // Only vertices: the rounding of other cells' centers is not defined.
        const vtkIdType corner = bytes.below(count);
        grid->InsertNextCell(VTK_VERTEX, 1, &corner);
      }
      result = grid;
    }
  }
  addArrays(bytes, result->GetPointData(), result->GetNumberOfPoints());
  addArrays(bytes, result->GetCellData(), result->GetNumberOfCells());
  return result;
}

} // namespace

vtkSmartPointer<vtkDataObject> newInput(
  ByteSource& bytes, std::vector<vtkSmartPointer<vtkDataSet>>& dataSets)
{
  const int kind = bytes.below(4);
  if (kind <= 1)
  {
    dataSets.push_back(newDataSet(bytes));
    return dataSets.back();
  }
  const int blocks = bytes.below(4);
  vtkNew<vtkMultiBlockDataSet> multi;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  for (int block = 0; block < blocks; ++block)
  {
    if (bytes.below(6) == 0)
    {
      multi->SetNumberOfBlocks(static_cast<unsigned int>(block) + 1);
      continue;
    }
    dataSets.push_back(newDataSet(bytes));
    multi->SetBlock(static_cast<unsigned int>(block), dataSets.back());
    collection->SetPartition(static_cast<unsigned int>(block), 0, dataSets.back());
  }
  return kind == 2 ? vtkSmartPointer<vtkDataObject>(multi)
                   : vtkSmartPointer<vtkDataObject>(collection);
}
