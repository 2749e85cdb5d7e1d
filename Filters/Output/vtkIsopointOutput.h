// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOutput_h
#define vtkIsopointOutput_h

#include "Core/ExtractionRequest.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

namespace isopoint
{
struct Execution;
}
class vtkCellArray;
class vtkDataObject;
class vtkPoints;
class vtkPolyData;

/// The positions of the isopoints of all surfaces, one surface after the other.
/// @param type VTK_FLOAT or VTK_DOUBLE
/// @throws std::bad_alloc
vtkSmartPointer<vtkPoints> vtkNewIsopointPositions(const isopoint::Execution& execution,
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, int type);

/// One vertex cell per point.
/// @throws std::bad_alloc
vtkSmartPointer<vtkCellArray> vtkNewIsopointVertices(vtkIdType count);

/// One polyline through at least one point, in their order.
/// @throws std::bad_alloc
vtkSmartPointer<vtkCellArray> vtkNewIsopointPolyline(vtkIdType count);

/// Adds the cell array IsCap to triangles with caps.
/// @throws std::bad_alloc
void vtkAddIsopointCaps(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPolyData* output);

/// The triangles of all surfaces, on the points of vtkNewIsopointPositions().
/// @throws std::bad_alloc
vtkSmartPointer<vtkCellArray> vtkNewIsopointTriangles(
  const isopoint::Execution& execution, const std::vector<isopoint::ExtractedIsosurface>& surfaces);

/// Marks as duplicates the points counted on other ranks, their vertices, and other ranks'
/// triangles.
/// @throws std::bad_alloc
void vtkAddIsopointGhosts(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, vtkPolyData* output);

/// A new, empty output for a composite input whose blocks are contoured separately: of the same
/// type, or for an AMR a vtkMultiBlockDataSet of levels.
vtkSmartPointer<vtkDataObject> vtkNewIsopointComposite(vtkDataObject* input);

#endif
