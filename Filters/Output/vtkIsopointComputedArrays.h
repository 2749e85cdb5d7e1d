// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkIsopointComputedArrays_h
#define vtkIsopointComputedArrays_h

#include "Core/ExtractionRequest.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

namespace isopoint
{
struct Execution;
struct Options;
} // namespace isopoint
class vtkFloatArray;
class vtkPolyData;
class vtkUnsignedCharArray;

/**
 * The arrays that are computed for isopoints: normals, splats, gradients and orders of fits. They
 * hold the isopoints of all surfaces, one surface after the other.
 */
class vtkIsopointComputedArrays
{
public:
  /**
   * The arrays that some options ask for.
   * @param count the number of isopoints of all surfaces
   * @throws std::bad_alloc
   */
  vtkIsopointComputedArrays(const isopoint::Options& options, vtkIdType count);

  /**
   * Writes the tuples of all isopoints.
   */
  void Write(const isopoint::Execution& execution,
    const std::vector<isopoint::ExtractedIsosurface>& surfaces);

  /**
   * Adds the arrays to the point data, the normals as the active ones. Those of the shapes of
   * splats become cell data of the vertices, hidden from menus, the axes as the active vectors.
   * @returns the names of the arrays that replaced another one
   */
  std::vector<std::string> AddTo(vtkPolyData* output) const;

private:
  bool IsProjected; // whether fits move the isopoints
  vtkSmartPointer<vtkFloatArray> Normals;
  vtkSmartPointer<vtkFloatArray> Radius;
  vtkSmartPointer<vtkFloatArray> SplatAxis;
  vtkSmartPointer<vtkFloatArray> SplatPolygon;
  vtkSmartPointer<vtkFloatArray> Gradients;
  vtkSmartPointer<vtkUnsignedCharArray> ProjectionOrder;
};

#endif
