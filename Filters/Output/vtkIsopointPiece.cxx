// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointPiece.h"

#include "Input/vtkIsopointBlocks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace
{

/// Takes the tuples of some ids, in their order.
void takeTuples(vtkDataSetAttributes* attributes, vtkIdList* ids)
{
  const auto whole = vtkSmartPointer<vtkDataSetAttributes>::Take(attributes->NewInstance());
  whole->ShallowCopy(attributes);
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(ids->GetNumberOfIds());
  std::iota(places->begin(), places->end(), vtkIdType{ 0 });
  attributes->Initialize();
  attributes->CopyAllOn();
  attributes->CopyAllocate(whole, ids->GetNumberOfIds());
  attributes->CopyData(whole, ids, places);
}

void takePiece(int piece, int pieces, vtkPolyData* surface)
{
  vtkCellArray* const all =
    surface->GetNumberOfPolys() > 0 ? surface->GetPolys() : surface->GetVerts();
  const vtkIdType count = all->GetNumberOfCells();
  const vtkIdType begin = count * std::clamp(piece, 0, pieces) / pieces;
  const vtkIdType end = count * std::clamp(piece + 1, 0, pieces) / pieces;

  // Points used by the piece keep their order.
  constexpr vtkIdType unused = -1;
  std::vector<vtkIdType> newIds(static_cast<std::size_t>(surface->GetNumberOfPoints()), unused);
  const auto newId = [&newIds](vtkIdType id) -> vtkIdType&
  { return newIds[static_cast<std::size_t>(id)]; };
  vtkNew<vtkIdList> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = begin; cell < end; ++cell)
  {
    cells->InsertNextId(cell);
    all->GetCellAtId(cell, corners);
    std::for_each(corners->begin(), corners->end(), [&](vtkIdType id) { newId(id) = 0; });
  }
  vtkNew<vtkIdList> points;
  for (std::size_t i = 0; i < newIds.size(); ++i)
  {
    if (newIds[i] != unused)
    {
      newIds[i] = points->InsertNextId(static_cast<vtkIdType>(i));
    }
  }

  vtkNew<vtkCellArray> taken;
  taken->AllocateExact(end - begin, all->GetMaxCellSize() * (end - begin));
  for (vtkIdType cell = begin; cell < end; ++cell)
  {
    all->GetCellAtId(cell, corners);
    std::transform(corners->begin(), corners->end(), corners->begin(), newId);
    taken->InsertNextCell(corners);
  }
  vtkNew<vtkPoints> places;
  places->SetDataType(surface->GetPoints()->GetDataType());
  surface->GetPoints()->GetPoints(points, places);
  surface->SetPoints(places);
  if (surface->GetNumberOfPolys() > 0)
  {
    surface->SetPolys(taken);
  }
  else
  {
    surface->SetVerts(taken);
  }
  takeTuples(surface->GetPointData(), points);
  takeTuples(surface->GetCellData(), cells);
}

} // namespace

void vtkTakeIsopointPiece(int piece, int pieces, vtkDataObject* output)
{
  for (vtkDataObject* const leaf : vtkListIsopointLeaves(output))
  {
    takePiece(piece, pieces, vtkPolyData::SafeDownCast(leaf));
  }
}
