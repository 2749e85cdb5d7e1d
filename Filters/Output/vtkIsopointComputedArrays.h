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
}
class vtkDataArray;
class vtkFloatArray;
class vtkPolyData;

/**
 * The arrays that are computed for isopoints: normals, splats, gradients and orders of fits. They
 * hold the isopoints of all surfaces, one surface after the other.
 */
class vtkIsopointComputedArrays
{
public:
  struct Choice
  {
    bool Normals = false;
    bool Splats = false;
    bool Gradients = false;
    bool ProjectionOrder = false;
    bool IsProjected = false; // whether fits move the isopoints

    /// Whether any array describes splats or their normals.
    bool NeedsSplats() const { return this->Normals || this->Splats; }
  };

  /**
   * @param choice the arrays to compute
   * @param count the number of isopoints of all surfaces
   * @throws std::bad_alloc
   */
  vtkIsopointComputedArrays(const Choice& choice, vtkIdType count);

  /**
   * Writes the tuples of the next surface.
   */
  void Append(const isopoint::Execution& execution, const isopoint::ExtractedIsosurface& extracted);

  /**
   * The number of isopoints written so far around which no fit holds, without those that are
   * counted on other ranks.
   */
  vtkIdType GetNumberWithoutFit() const { return this->WithoutFit; }

  /**
   * Adds the arrays to the point data, the normals as the active ones. Those of the shapes of
   * splats become cell data of the vertices, hidden from menus, the axes as the active vectors.
   * @returns the names of the arrays that replaced another one
   */
  std::vector<std::string> AddTo(vtkPolyData* output) const;

private:
  void SetSplat(vtkIdType tuple, const isopoint::Splat& splat);
  void SetFit(vtkIdType tuple, const isopoint::LocalFit& fit);

  Choice Chosen;
  vtkIdType Next = 0;
  vtkIdType WithoutFit = 0;
  vtkSmartPointer<vtkDataArray> Normals;
  vtkSmartPointer<vtkDataArray> Radius;
  vtkSmartPointer<vtkDataArray> SplatAxis;
  vtkSmartPointer<vtkFloatArray> SplatPolygon;
  vtkSmartPointer<vtkDataArray> Gradients;
  vtkSmartPointer<vtkDataArray> ProjectionOrder;
};

#endif
