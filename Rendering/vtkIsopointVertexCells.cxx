// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointVertexCells.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

vtkIsopointVertexCells::vtkIsopointVertexCells(vtkDataSet* data)
{
  const auto polydata = vtkPolyData::SafeDownCast(data);
  vtkCellArray* const vertices = polydata ? polydata->GetVerts() : nullptr;
  const vtkIdType cells = vertices ? vertices->GetNumberOfCells() : data->GetNumberOfCells();
  vtkNew<vtkIdList> points;
  // Whether a cell is a VTK_VERTEX; otherwise `points` are those of a VTK_POLY_VERTEX, or none.
  const auto readsSingle = [&](vtkIdType cell)
  {
    points->Reset();
    const int type = vertices ? VTK_EMPTY_CELL : data->GetCellType(cell);
    if (vertices)
    {
      vertices->GetCellAtId(cell, points);
    }
    else if (type == VTK_VERTEX || type == VTK_POLY_VERTEX)
    {
      data->GetCellPoints(cell, points);
    }
    return points->GetNumberOfIds() == 1 && type != VTK_POLY_VERTEX;
  };
  vtkIdType inOrder = 0;
  const vtkIdType count = data->GetNumberOfPoints();
  while (inOrder < count && inOrder < cells && readsSingle(inOrder) && points->GetId(0) == inOrder)
  {
    ++inOrder;
  }
  this->AreInOrder = inOrder == count;
  for (vtkIdType cell = 0; !this->AreInOrder && cell < cells; ++cell)
  {
    const bool isSingle = readsSingle(cell);
    if (this->Cells.empty() && points->GetNumberOfIds() > 0)
    {
      this->Cells.assign(static_cast<std::size_t>(count), -1);
    }
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      vtkIdType& own = this->Cells[static_cast<std::size_t>(points->GetId(i))];
      if (own == -1 || (own < -1 && isSingle))
      {
        own = isSingle ? cell : -2 - cell;
      }
    }
  }
}
