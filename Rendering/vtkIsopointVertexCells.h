// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointVertexCells_h
#define vtkIsopointVertexCells_h

#include "vtkType.h"

#include <cstddef>
#include <vector>

class vtkDataSet;

/// The vertex cell of each point of a data set. Takes no memory if cell i is the vertex of point i
/// for all points. Reading is thread-safe.
class vtkIsopointVertexCells
{
public:
  /// @throws std::bad_alloc
  explicit vtkIsopointVertexCells(vtkDataSet* data);

  /// The first VTK_VERTEX of the point, or -1.
  vtkIdType Single(vtkIdType point) const
  {
    const vtkIdType cell = this->Stored(point);
    return cell < 0 ? -1 : cell;
  }

  /// As Single(), otherwise the first VTK_POLY_VERTEX with the point, or -1.
  vtkIdType Any(vtkIdType point) const
  {
    const vtkIdType cell = this->Stored(point);
    return cell < -1 ? -2 - cell : cell;
  }

private:
  vtkIdType Stored(vtkIdType point) const
  {
    if (this->AreInOrder)
    {
      return point;
    }
    return this->Cells.empty() ? -1 : this->Cells[static_cast<std::size_t>(point)];
  }

  bool AreInOrder = false;
  std::vector<vtkIdType> Cells; // -2 - id for a VTK_POLY_VERTEX; none: -1
};

#endif
