// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkIsopointOutput.h"

#include "Isopoint/Base/Vector.h"
#include "vtkIsopointAllocation.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUniformGridAMR.h"
#include "vtkUnsignedCharArray.h"

#include <cstddef>

vtkIdType vtkCountIsopoints(const std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  std::size_t count = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    count += extracted.surface.size();
  }
  return static_cast<vtkIdType>(count);
}

vtkSmartPointer<vtkPoints> vtkNewIsopointPositions(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, int type)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  vtkAllocateTuples(points->GetData(), vtkCountIsopoints(surfaces));
  vtkIdType next = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    for (const isopoint::Vector& position : extracted.surface.positions)
    {
      points->SetPoint(next++, position.data());
    }
  }
  return points;
}

vtkSmartPointer<vtkCellArray> vtkNewIsopointVertices(vtkIdType count)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  vtkAllocateTuples(offsets, count + 1);
  vtkAllocateTuples(connectivity, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, i);
    connectivity->SetValue(i, i);
  }
  offsets->SetValue(count, count);
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, connectivity);
  return vertices;
}

vtkSmartPointer<vtkCellArray> vtkNewIsopointTriangles(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces)
{
  vtkIdType count = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    count += static_cast<vtkIdType>(extracted.triangles.size());
  }
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  vtkAllocateTuples(offsets, count + 1);
  vtkAllocateTuples(connectivity, 3 * count);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkIdType next = 0;
  vtkIdType firstPoint = 0;
  for (const isopoint::ExtractedIsosurface& extracted : surfaces)
  {
    for (const isopoint::SurfaceTriangle& triangle : extracted.triangles)
    {
      for (const std::size_t vertex : triangle)
      {
        connectivity->SetValue(next++, firstPoint + static_cast<vtkIdType>(vertex));
      }
    }
    firstPoint += static_cast<vtkIdType>(extracted.surface.size());
  }
  auto triangles = vtkSmartPointer<vtkCellArray>::New();
  triangles->SetData(offsets, connectivity);
  return triangles;
}

void vtkAddIsopointGhosts(vtkPolyData* output, vtkIdType first)
{
  const auto add = [&](vtkDataSetAttributes* attributes, unsigned char duplicate)
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    const vtkIdType count = output->GetNumberOfPoints();
    vtkAllocateTuples(ghosts, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      ghosts->SetValue(i, i < first ? static_cast<unsigned char>(0) : duplicate);
    }
    attributes->AddArray(ghosts);
  };
  add(output->GetPointData(), vtkDataSetAttributes::DUPLICATEPOINT);
  add(output->GetCellData(), vtkDataSetAttributes::DUPLICATECELL);
}

vtkSmartPointer<vtkDataObject> vtkNewIsopointComposite(vtkDataObject* input)
{
  return vtkUniformGridAMR::SafeDownCast(input)
           ? vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkMultiBlockDataSet>::New())
           : vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
}
