// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointOutput_h
#define vtkIsopointOutput_h

#include "Isopoint/IsosurfaceExtractor.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkCellArray;
class vtkCompositeDataSet;
class vtkDataObject;
class vtkPoints;
class vtkPolyData;

/**
 * The number of isopoints of all surfaces.
 */
vtkIdType vtkCountIsopoints(const std::vector<isopoint::ExtractedIsosurface>& surfaces);

/**
 * The positions of the isopoints of all surfaces, one surface after the other.
 * @param type VTK_FLOAT or VTK_DOUBLE
 * @throws std::bad_alloc
 */
vtkSmartPointer<vtkPoints> vtkNewIsopointPositions(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces, int type);

/**
 * One vertex cell for each of `count` points.
 * @throws std::bad_alloc
 */
vtkSmartPointer<vtkCellArray> vtkNewIsopointVertices(vtkIdType count);

/**
 * The triangles of all surfaces, whose points are those of vtkNewIsopointPositions().
 * @throws std::bad_alloc
 */
vtkSmartPointer<vtkCellArray> vtkNewIsopointTriangles(
  const std::vector<isopoint::ExtractedIsosurface>& surfaces);

/**
 * A new, empty output for a composite input whose blocks are contoured by themselves: an object of
 * the same type, or a vtkMultiBlockDataSet (of levels) for an AMR.
 */
vtkSmartPointer<vtkDataObject> vtkNewIsopointComposite(vtkDataObject* input);

/**
 * Gives an output of vtkNewIsopointComposite() the structure of the input, with surfaces in place
 * of the leaves.
 * @param surfaces one for each leaf, in the order of traversal; null for none
 */
void vtkSetIsopointLeaves(vtkDataObject* input,
  const std::vector<vtkSmartPointer<vtkPolyData>>& surfaces, vtkCompositeDataSet* output);

#endif
