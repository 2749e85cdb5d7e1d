// SPDX-License-Identifier: GPL-3.0-or-later
#include "Output/vtkIsopointOutput.h"

#include "Common/vtkIsopointArrays.h"
#include "Core/OutputArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

vtkSmartPointer<vtkPoints> vtkNewIsopointPositions(const isopoint::Execution& execution,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, int type)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  vtkAllocateTuples(points->GetData(), static_cast<vtkIdType>(isopoint::countIsopoints(surfaces)));
  const auto write = [&](auto* coordinates)
  {
    for (const isopoint::ExtractedIsosurface& extracted : surfaces)
    {
      isopoint::writePositions(execution, extracted.surface, coordinates);
      coordinates += 3 * extracted.surface.size();
    }
  };
  if (type == VTK_FLOAT)
  {
    write(vtkFloatArray::FastDownCast(points->GetData())->GetPointer(0));
  }
  else
  {
    write(vtkDoubleArray::FastDownCast(points->GetData())->GetPointer(0));
  }
  return points;
}

namespace
{

/// Cells of `size` points each.
vtkSmartPointer<vtkCellArray> newCells(vtkIdType size, vtkIdTypeArray* connectivity)
{
  const vtkIdType count = connectivity->GetNumberOfValues() / size;
  vtkNew<vtkIdTypeArray> offsets;
  vtkAllocateTuples(offsets, count + 1);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, size * i);
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// 0 .. count - 1
vtkSmartPointer<vtkIdTypeArray> numbersBelow(vtkIdType count)
{
  auto numbers = vtkSmartPointer<vtkIdTypeArray>::New();
  vtkAllocateTuples(numbers, count);
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + count, vtkIdType{ 0 });
  return numbers;
}

} // namespace

vtkSmartPointer<vtkCellArray> vtkNewIsopointVertices(vtkIdType count)
{
  return newCells(1, numbersBelow(count));
}

vtkSmartPointer<vtkCellArray> vtkNewIsopointPolyline(vtkIdType count)
{
  return newCells(count, numbersBelow(count));
}

vtkSmartPointer<vtkCellArray> vtkNewIsopointTriangles(
  const isopoint::Execution& execution, const std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  vtkNew<vtkIdTypeArray> connectivity;
  vtkAllocateTuples(connectivity, 3 * static_cast<vtkIdType>(isopoint::countTriangles(surfaces)));
  vtkIdType* corners = connectivity->GetPointer(0);
  std::size_t firstPoint = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    isopoint::writeTriangles(execution, extracted, firstPoint, corners);
    corners += 3 * extracted.triangles.size();
    firstPoint += extracted.surface.size();
  }
  return newCells(3, connectivity);
}

void vtkAddIsopointCaps(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPolyData* output)
{
  vtkNew<vtkUnsignedCharArray> caps;
  caps->SetName("IsCap");
  vtkAllocateTuples(caps, static_cast<vtkIdType>(isopoint::countTriangles(surfaces)));
  unsigned char* next = caps->GetPointer(0);
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    next = std::copy(extracted.areCaps.begin(), extracted.areCaps.end(), next);
  }
  output->GetCellData()->AddArray(caps);
}

void vtkAddIsopointGhosts(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPolyData* output)
{
  std::vector<unsigned char> points;
  std::vector<unsigned char> triangles;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    for (std::size_t i = 0; i < extracted.surface.size(); ++i)
    {
      const bool isElsewhere = !extracted.areGhosts.empty() && extracted.areGhosts[i];
      points.push_back(isElsewhere ? 1 : 0);
    }
    const std::size_t count = extracted.triangles.size();
    triangles.insert(triangles.end(), count - extracted.ghostTriangles, 0);
    triangles.insert(triangles.end(), extracted.ghostTriangles, 1);
  }
  const auto add = [](const std::vector<unsigned char>& isGhost, unsigned char duplicate,
                     vtkDataSetAttributes* attributes)
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    vtkAllocateTuples(ghosts, static_cast<vtkIdType>(isGhost.size()));
    std::transform(isGhost.begin(), isGhost.end(), ghosts->GetPointer(0),
      [duplicate](unsigned char is) { return static_cast<unsigned char>(is * duplicate); });
    attributes->AddArray(ghosts);
  };
  const bool areVertices = output->GetNumberOfVerts() > 0;
  add(points, vtkDataSetAttributes::DUPLICATEPOINT, output->GetPointData());
  add(areVertices ? points : triangles, vtkDataSetAttributes::DUPLICATECELL, output->GetCellData());
}

vtkSmartPointer<vtkDataObject> vtkNewIsopointComposite(vtkDataObject* input)
{
  return vtkUniformGridAMR::SafeDownCast(input)
           ? vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkMultiBlockDataSet>::New())
           : vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
}
